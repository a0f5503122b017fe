#python
# SPDX-License-Identifier: BSD-3-Clause
# Moves what lies on the belt: the belt has its speed in each step of the physics, and is put back before each step of
# the simulation. Programs set the speed, m/s, with sim.writeCustomTableData(conveyor, '__ctrl__', {vel = 0.2}), which
# the script answers with '__state__', or by the script's parameter conveyorBeltVelocity.


def sysCall_init():
    self.conveyor, self.drive = sim.getObject('.'), sim.getObject('./drive')
    self.position = 0.0  # m, of the belt


def sysCall_actuation():
    wanted = sim.readCustomTableData(self.conveyor, '__ctrl__') or {}
    speed = wanted.get('vel', sim.getScriptSimulationParameter(sim.handle_self, 'conveyorBeltVelocity'))
    sim.setJointPosition(self.drive, 0.0)
    sim.setJointTargetVelocity(self.drive, speed)
    self.position += speed * sim.getSimulationTimeStep()
    sim.writeCustomTableData(self.conveyor, '__state__', {'pos': self.position, 'vel': speed})
