#python
# SPDX-License-Identifier: BSD-3-Clause
# Follows a dark line: the outer sensors turn the robot towards the side on which they see it. Without any line it goes
# on turning to where it was last. Once a program commands the motors, the script leaves them to it.
SPEED = 0.1  # m/s
WHEEL_RADIUS = 0.027  # m
DARK = 0.3  # mean intensity of a sensor's image
MEAN_INTENSITY = 10  # in the values of readVisionSensor


def sysCall_init():
    self.motors = [sim.getObject(f'./Dynamic{side}Joint') for side in ('Left', 'Right')]
    self.sensors = [sim.getObject(f'./{side}Sensor') for side in ('Left', 'Middle', 'Right')]
    self.turn = 0  # -1 left, 1 right
    self.speeds = [0.0, 0.0]  # rad/s, the last commands


def sysCall_actuation():
    if [sim.getJointTargetVelocity(motor) for motor in self.motors] != self.speeds:
        return
    left, middle, right = (sim.readVisionSensor(sensor)[1][MEAN_INTENSITY] < DARK for sensor in self.sensors)
    if left != right:
        self.turn = 1 if right else -1
    elif middle:
        self.turn = 0
    self.speeds = [SPEED / WHEEL_RADIUS * (0.2 if self.turn == inner else 1.0) for inner in (-1, 1)]
    for motor, speed in zip(self.motors, self.speeds, strict=True):
        sim.setJointTargetVelocity(motor, speed)
