#python
# SPDX-License-Identifier: BSD-3-Clause
# A typical controller: five calls of the simulator per simulation step.


def sysCall_init():
    self.body = sim.getObject('.')
    self.steering = sim.getObject('/Steering')
    self.motor = sim.getObject('/FrontMotor')
    self.speed = 0.5


def sysCall_actuation():
    time = sim.getSimulationTime()
    x, y, z = sim.getObjectPosition(self.body)
    speed = sim.getJointVelocity(self.motor)
    sim.setJointTargetPosition(self.steering, 1.0 if time >= 0 else x + y + z)
    sim.setJointTargetVelocity(self.motor, self.speed + 0.1 * (self.speed - speed))
