#python
# SPDX-License-Identifier: BSD-3-Clause
# Fixes the base of an arm to the world where it is put: the base is heavy and has no weight, and a spring and a damper
# hold it against the arm. A program may set it to another pose at any time.
import math

from bubblesim.geometry.rotations import product

MASS = 1e6  # kg, and kg m^2, of the base
STIFFNESS, DAMPING = 25.0, 10.0  # 1/s^2, 1/s
MOVED = 0.01  # m, rad: the base was set to another pose


def sysCall_init():
    self.base = sim.getObject('.')
    self.place = sim.getObjectPose(self.base)


def sysCall_actuation():
    pose = sim.getObjectPose(self.base)
    offset = [a - b for a, b in zip(pose[:3], self.place[:3], strict=True)]
    turn = turn_between(self.place[3:], pose[3:])
    if max(map(abs, offset + turn)) > MOVED:
        self.place, offset, turn = pose, [0.0] * 3, [0.0] * 3
    linear, angular = sim.getObjectVelocity(self.base)
    sim.addForceAndTorque(self.base, pull(offset, linear), pull(turn, angular))


def pull(way, velocity):
    return [-MASS * (STIFFNESS * a + DAMPING * v) for a, v in zip(way, velocity, strict=True)]


def turn_between(start, end):
    """Return the rotation from one quaternion to another as a vector in world axes, for small angles, in rad."""
    x, y, z, w = start
    *turn, cosine = product(end, [-x, -y, -z, w])
    return [2 * math.copysign(part, part * cosine) for part in turn]
