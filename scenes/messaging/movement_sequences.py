#python
# SPDX-License-Identifier: BSD-3-Clause
# Carries out movements of an arm that a remote client sends and then starts by their names. The signal
# '/NAME_executedMovId' of the arm /NAME has the last one that is done, at first 'ready'.
import math

MOST_JERK = [80 * math.pi / 180 * 10] * 6  # rad/s^3, of movements that do not give theirs


def sysCall_init():
    self.joints = [sim.getObject('./joint', {'index': i}) for i in range(6)]
    self.signal = '/' + sim.getObjectAlias(sim.getObject('.')) + '_executedMovId'
    self.movements = {}
    self.wanted = []  # names of movements to do
    still = [0.0] * 6
    self.state = still, still, still  # positions, velocities, accelerations


def remoteApi_movementDataFunction(movement):
    self.movements[movement['id']] = movement


def remoteApi_executeMovement(name):
    self.wanted.append(name)


def sysCall_thread():
    sim.setStringSignal(self.signal, 'ready')
    while not sim.getSimulationStopping():
        if not self.wanted:
            sim.step()
            continue
        name = self.wanted.pop(0)
        movement = self.movements.pop(name)
        (follow_points if movement['type'] == 'pts' else move)(movement)
        sim.setStringSignal(self.signal, name)


def move(movement):
    positions, velocities, accelerations = self.state
    jerk = movement.get('maxJerk', MOST_JERK)
    *self.state, _ = sim.moveToConfig(
        -1, positions, velocities, accelerations, movement['maxVel'], movement['maxAccel'], jerk,
        movement['targetConfig'], movement.get('targetVel'), on_config, None, None)


def on_config(positions, velocities, accelerations, _):
    for joint, position in zip(self.joints, positions, strict=True):
        sim.setJointTargetPosition(joint, position)


def follow_points(movement):
    times = movement['times']
    start = sim.getSimulationTime()
    while (passed := sim.getSimulationTime() - start) < times[-1]:
        on_config([at(passed, times, movement[f'j{i + 1}']) for i in range(6)], None, None, None)
        sim.step()
    last = [movement[f'j{i + 1}'][-1] for i in range(6)]
    on_config(last, None, None, None)
    self.state = last, [0.0] * 6, [0.0] * 6


def at(time, times, values):
    after = next(i for i in range(1, len(times)) if times[i] >= time)
    share = (time - times[after - 1]) / (times[after] - times[after - 1])
    return values[after - 1] + share * (values[after] - values[after - 1])
