#python
# SPDX-License-Identifier: BSD-3-Clause
# The tip of an arm follows a dummy 'target' by inverse kinematics.
BENT = [0.0, 0.9, 0.0, -1.8, 0.0, 0.9, 0.0]  # rad, the tip at the target; upright, it could not move along the arm


def sysCall_init():
    base = sim.getObject('.')
    tip, target = sim.getObject('./tip'), sim.getObject('./target')
    for i, position in enumerate(BENT):
        joint = sim.getObject('./joint', {'index': i})
        sim.setJointPosition(joint, position)
        sim.setJointTargetPosition(joint, position)
    self.environment = simIK.createEnvironment()
    self.group = simIK.createGroup(self.environment)
    simIK.setGroupCalculation(self.environment, self.group, simIK.method_damped_least_squares, 0.02, 20)
    simIK.addElementFromScene(self.environment, self.group, base, tip, target, simIK.constraint_pose)


def sysCall_actuation():
    simIK.handleGroup(self.environment, self.group, {'syncWorlds': True})
