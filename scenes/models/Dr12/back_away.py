#python
# SPDX-License-Identifier: BSD-3-Clause
# Drives ahead, and back in a curve for 2 s when the bumper has touched something. Once a program commands the motors,
# the script leaves them to it.
TOUCHED = 1.0  # N


def sysCall_init():
    self.motors = [sim.getObject(f'./{side}Joint_') for side in ('left', 'right')]
    self.bumper = sim.getObject('./bumperForceSensor_')
    self.back_until = 0.0
    self.speeds = [0.0, 0.0]  # rad/s, the last commands


def sysCall_actuation():
    if [sim.getJointTargetVelocity(motor) for motor in self.motors] != self.speeds:
        return
    result, force, _ = sim.readForceSensor(self.bumper)
    now = sim.getSimulationTime()
    if result and max(abs(force[1]), abs(force[2])) > TOUCHED:
        self.back_until = now + 2.0
    self.speeds = [-1.75, -0.87] if now < self.back_until else [3.5, 3.5]
    for motor, speed in zip(self.motors, self.speeds, strict=True):
        sim.setJointTargetVelocity(motor, speed)
