#python
# SPDX-License-Identifier: BSD-3-Clause
# A Braitenberg vehicle: what a front sonar sees within half a metre slows the wheels, most of all the one on the other
# side, which turns the robot away; where that stops it, it turns on the spot. Once a program commands the motors, the
# script leaves them to it.
SPEED = 2.0  # rad/s
FAR, NEAR = 0.5, 0.2  # m: no effect, full effect
BLOCKED, TURN = 0.3, 1.5  # rad/s of both wheels, s
SLOWS_LEFT = (0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.4, 1.6)  # rad/s at full effect, from the left sonar to the right one


def sysCall_init():
    self.motors = [sim.getObject(f'./{side}Motor') for side in ('left', 'right')]
    self.sonars = [sim.getObject(f'./ultrasonicSensor[{i}]') for i in range(8)]
    self.speeds = [0.0, 0.0]  # rad/s, the last commands
    self.turns_until = -1.0  # s


def sysCall_actuation():
    if [sim.getJointTargetVelocity(motor) for motor in self.motors] != self.speeds:
        return
    effects = [effect(sonar) for sonar in self.sonars]
    self.speeds = [
        SPEED - sum(share * seen for share, seen in zip(slows, effects, strict=True))
        for slows in (SLOWS_LEFT, SLOWS_LEFT[::-1])
    ]
    now = sim.getSimulationTime()
    if max(self.speeds) < BLOCKED:
        self.turns_until = now + TURN
    if now < self.turns_until:
        self.speeds = [SPEED, -SPEED]
    for motor, speed in zip(self.motors, self.speeds, strict=True):
        sim.setJointTargetVelocity(motor, speed)


def effect(sonar):
    """Return how near a sonar sees something, from 0 to 1."""
    seen, distance, *_ = sim.readProximitySensor(sonar)
    return min(1.0, max(0.0, (FAR - distance) / (FAR - NEAR))) if seen > 0 else 0.0
