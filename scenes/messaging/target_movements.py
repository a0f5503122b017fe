#python
# SPDX-License-Identifier: BSD-3-Clause
# An arm whose tip follows its dummy 'target', and movements of the target that a remote client sends and then starts by
# their names. The signal '/NAME_executedMovId' of the arm /NAME has the last one that is done, at first 'ready'.
include follow_target

METRIC = [1, 1, 1, 0.1]  # of a motion: m, and rad as 0.1 m
MOST_JERK = [80.0]


def sysCall_thread():
    self.tip, self.target = sim.getObject('./tip'), sim.getObject('./target')
    self.joints = [sim.getObject('./joint', {'index': i}) for i in range(7)]
    signal = '/' + sim.getObjectAlias(sim.getObject('.')) + '_executedMovId'
    self.movements, self.wanted = {}, []
    sim.setStringSignal(signal, 'ready')
    while not sim.getSimulationStopping():
        if not self.wanted:
            sim.step()
            continue
        name = self.wanted.pop(0)
        (follow_points if self.movements[name]['type'] == 'pts' else move)(self.movements.pop(name))
        sim.setStringSignal(signal, name)


def remoteApi_getPoseAndConfig():
    return sim.getObjectPose(self.tip), [sim.getJointPosition(joint) for joint in self.joints]


def remoteApi_movementDataFunction(movement):
    self.movements[movement['id']] = movement


def remoteApi_executeMovement(name):
    self.wanted.append(name)


def move(movement):
    start = sim.getObjectPose(self.target)
    sim.moveToPose(-1, start, [movement['maxVel']], [movement['maxAccel']], MOST_JERK, movement['targetPose'],
                   lambda pose, *_: sim.setObjectPose(self.target, pose), None, METRIC)


def follow_points(movement):
    start = sim.getSimulationTime()
    poses = zip(*(movement[name] for name in ('x', 'y', 'z', 'qx', 'qy', 'qz', 'qw')))
    for time, pose in zip(movement['times'], poses, strict=True):
        while sim.getSimulationTime() - start < time:
            sim.step()
        sim.setObjectPose(self.target, list(pose))
