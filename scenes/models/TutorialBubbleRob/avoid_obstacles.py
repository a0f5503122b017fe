#python
# SPDX-License-Identifier: BSD-3-Clause
# Drives ahead. When the nose sees something, it drives backwards in a curve for 4 s. Once a program commands the
# motors, the script leaves them to it.
SPEED = 3.0  # rad/s
NEAR = 0.3  # m
BACKWARDS = 4.0  # s


def sysCall_init():
    self.motors = [sim.getObject(f'./{side}Motor') for side in ('left', 'right')]
    self.nose = sim.getObject('./sensingNose')
    self.until = -1.0
    self.speeds = [0.0, 0.0]  # rad/s, the last commands


def sysCall_actuation():
    if [sim.getJointTargetVelocity(motor) for motor in self.motors] != self.speeds:
        return
    seen, distance, *_ = sim.readProximitySensor(self.nose)
    now = sim.getSimulationTime()
    if seen > 0 and distance < NEAR:
        self.until = now + BACKWARDS
    self.speeds = [SPEED, SPEED] if self.until < now else [-SPEED / 2, -SPEED / 8]
    for motor, speed in zip(self.motors, self.speeds, strict=True):
        sim.setJointTargetVelocity(motor, speed)
