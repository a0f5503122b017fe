#python
# SPDX-License-Identifier: BSD-3-Clause
# Walks to ./goalDummy, 2 m ahead, and back to where he came from, for ever. Where a program puts the dummy, he stays.
import math

SPEED = 0.8  # m/s
TURN = 2.0  # rad/s
STRIDE = 1.3  # m, two steps
NEAR = 0.1  # m
AHEAD = [2, 0, 0]  # m, the goal of the file


def sysCall_init():
    self.bill, self.goal = sim.getObject('.'), sim.getObject('./goalDummy')
    self.joints = {
        side: [sim.getObject(f'./{side}{name}Joint') for name in ('Leg', 'Knee', 'Ankle', 'Shoulder', 'Elbow')]
        for side in ('left', 'right')
    }
    self.turns_back = math.dist(sim.getObjectPosition(self.goal, self.bill), AHEAD) < 1e-6
    self.start, self.wanted = sim.getObjectPosition(self.bill), sim.getObjectPosition(self.goal)
    sim.setObjectParent(self.goal, -1, True)
    self.walked = 0.0


def sysCall_actuation():
    goal = sim.getObjectPosition(self.goal)
    self.turns_back = self.turns_back and math.dist(goal, self.wanted) < 1e-6
    x, y, z = sim.getObjectPosition(self.bill)
    *_, heading = sim.getObjectOrientation(self.bill)
    dt = sim.getSimulationTimeStep()
    distance = math.hypot(goal[0] - x, goal[1] - y)
    if distance < NEAR:
        if self.turns_back:
            self.start, self.wanted = goal, self.start
            sim.setObjectPosition(self.goal, self.wanted)
        pose_limbs(0.0)
        return
    error = math.remainder(math.atan2(goal[1] - y, goal[0] - x) - heading, math.tau)
    heading += min(TURN * dt, max(-TURN * dt, error))
    step = min(distance, SPEED * dt * max(0.0, math.cos(error)))
    self.walked += step
    sim.setObjectPosition(self.bill, [x + step * math.cos(heading), y + step * math.sin(heading), z])
    sim.setObjectOrientation(self.bill, [0, 0, heading])
    pose_limbs(1.0)


def pose_limbs(swing):
    """Put the limbs where they are in a stride; a swing of 0 is standing."""
    for side, phase in (('left', 0.0), ('right', math.pi)):
        angle = math.tau * self.walked / STRIDE + phase
        leg, knee, ankle, shoulder, elbow = self.joints[side]
        forward, lift = swing * 0.5 * math.sin(angle), swing * 0.45 * (1 + math.cos(angle))
        sim.setJointPosition(leg, -forward)
        sim.setJointPosition(knee, lift)
        sim.setJointPosition(ankle, forward - lift if lift < forward else 0.0)
        sim.setJointPosition(shoulder, 0.7 * forward)
        sim.setJointPosition(elbow, -swing * 0.4)
