#python
# SPDX-License-Identifier: BSD-3-Clause
# Opens and closes the fingers when the integer signal RG2_open is set to 1 or 0. Without it, programs command
# openCloseJoint.
SPEED = 0.1  # m/s


def sysCall_init():
    self.joint = sim.getObject('./openCloseJoint')


def sysCall_actuation():
    wanted = sim.getInt32Signal('RG2_open')
    if wanted is not None:
        sim.setJointTargetVelocity(self.joint, SPEED if wanted else -SPEED)
