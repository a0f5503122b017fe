#python
# SPDX-License-Identifier: BSD-3-Clause
# Flies to the position of ./target and turns to its heading. The four propellers push along the axis of the body; a
# torque about it stands for the drag of the blades.
from bubblesim.controllers.multicopter import Airframe, Goal, MulticopterControl, RotorPlace, State
from bubblesim.geometry.rotations import heading_of, matrix

PLACES = ((0.13, 0.13, 1), (-0.13, 0.13, -1), (-0.13, -0.13, 1), (0.13, -0.13, -1))  # x, y, turning
ROTORS = tuple(RotorPlace(*place) for place in PLACES)
BEGINNING = [0, 0, 0.51]  # m, of the target
AIRFRAME = Airframe(mass=0.5, inertia=(0.0043, 0.0043, 0.0075), max_speed=600.0, rotors=ROTORS)


def sysCall_init():
    self.body, self.target = sim.getObject('.'), sim.getObject('./target')
    self.propellers = [sim.getObject(f'./propeller[{i}]/respondable') for i in range(4)]
    self.control = MulticopterControl(AIRFRAME)
    if sim.getObjectPosition(self.target) == BEGINNING:  # the robot may have been placed elsewhere
        sim.setObjectPose(self.target, sim.getObjectPose(self.body))


def sysCall_dyn(data):
    if data['afterStep']:
        return
    *position, x, y, z, w = sim.getObjectPose(self.target)
    linear, angular = sim.getObjectVelocity(self.body)
    state = State(sim.getObjectPosition(self.body), sim.getObjectQuaternion(self.body), linear, angular)
    goal = Goal(position, heading=heading_of(x, y, z, w))
    up = [row[2] for row in matrix(state.orientation)]
    speeds = self.control.update(state, goal, data['dt'])
    for propeller, rotor, speed in zip(self.propellers, ROTORS, speeds, strict=True):
        thrust = AIRFRAME.thrust_coefficient * speed**2
        drag = -rotor.turning * AIRFRAME.torque_length * thrust
        sim.addForceAndTorque(propeller, [thrust * part for part in up], [drag * part for part in up])
