#python
# SPDX-License-Identifier: BSD-3-Clause
# Mecanum wheels, which roll ahead at negative speeds: the rollers turn their speeds into a velocity of the platform
# along x, along y and about z. A force and a torque bring the platform to it, as far as the grip of the wheels allows.
import math

RADIUS, REACH = 0.05, 0.228 + 0.158  # m: of a wheel; half the distances of the axles and of the tracks
GRIP = 0.8
MASS, INERTIA = 30.0, 1.1  # kg, kg m^2 about z, with the arm
SHARE = 0.2  # of the difference of velocity, in a physics substep


def sysCall_init():
    self.body = sim.getObject('.')
    self.wheels = [sim.getObject(f'./rollingJoint_{name}') for name in ('fl', 'rl', 'rr', 'fr')]


def sysCall_dyn(data):
    if data['afterStep']:
        return
    fl, rl, rr, fr = (-sim.getJointVelocity(wheel) * RADIUS for wheel in self.wheels)
    ahead, left, turning = (fl + rl + rr + fr) / 4, (rl - fl + fr - rr) / 4, (rr + fr - fl - rl) / 4 / REACH
    *_, heading = sim.getObjectOrientation(self.body)
    cos, sin = math.cos(heading), math.sin(heading)
    linear, angular = sim.getObjectVelocity(self.body)
    share = SHARE / data['dt']
    force = [
        MASS * share * (cos * ahead - sin * left - linear[0]),
        MASS * share * (sin * ahead + cos * left - linear[1]),
    ]
    slip = max(1.0, math.hypot(*force) / (GRIP * MASS * 9.81))
    torque = INERTIA * share * (turning - angular[2])
    largest = GRIP * MASS * 9.81 * REACH
    sim.addForceAndTorque(self.body, [*(part / slip for part in force), 0], [0, 0, min(largest, max(-largest, torque))])
