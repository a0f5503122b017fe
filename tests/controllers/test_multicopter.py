# SPDX-License-Identifier: BSD-3-Clause
"""The flight control, flying the model of the scene quadcopter."""

import math

import pytest

import bubblesim
from bubblesim.controllers.multicopter import GRAVITY, Airframe, Goal, MulticopterControl, State
from bubblesim.gazebo_plugins.robots import GazeboPlugins
from bubblesim.geometry.rotations import heading_of

SLOWDOWN = 10.0
HOVER = math.sqrt(Airframe().mass * GRAVITY / 4 / Airframe().thrust_coefficient)


class Flight:
    """The scene without its script and without ROS."""

    def __init__(self) -> None:
        self.simulation = bubblesim.Simulation("quadcopter", seed=3)
        self.plugins = GazeboPlugins(self.simulation, None)
        self.control = MulticopterControl(Airframe())
        self.body = self.simulation.object("/Quadcopter/base_link")
        self.rotors = [self.simulation.object(f"/Quadcopter/rotor_{i}_joint") for i in range(4)]
        self.goal = Goal([0.0, 0.0, 1.0])

    def fly(self, seconds: float) -> float:
        """Fly and return the greatest distance to the goal."""
        dt = self.simulation.time_step
        farthest = 0.0
        for _ in range(round(seconds / dt)):
            self.goal = self.goal.after(dt, lowest=0.0)
            body = self.body
            state = State(body.position, body.orientation, body.linear_velocity, body.angular_velocity)
            for rotor, speed in zip(self.rotors, self.control.update(state, self.goal, dt), strict=True):
                rotor.target_velocity = speed / SLOWDOWN
            self.simulation.step()
            farthest = max(farthest, math.dist(self.body.position, self.goal.position))
        return farthest

    def rotor_speeds(self) -> list[float]:
        return [abs(rotor.joint_velocity) * SLOWDOWN for rotor in self.rotors]


@pytest.fixture
def flight() -> Flight:
    return Flight()


def test_it_takes_off_and_hovers_within_a_millimetre(flight: Flight) -> None:
    flight.fly(12.0)
    assert flight.fly(5.0) < 1e-3
    assert flight.rotor_speeds() == pytest.approx([HOVER] * 4, rel=2e-3), "4 k w^2 = m g"


def test_it_flies_to_a_place_and_turns(flight: Flight) -> None:
    flight.fly(5.0)
    flight.goal = Goal([2.0, -1.0, 2.0], heading=1.5)
    flight.fly(15.0)
    assert list(flight.body.position) == pytest.approx([2.0, -1.0, 2.0], abs=5e-3)
    assert heading_of(*flight.body.orientation) == pytest.approx(1.5, abs=5e-3)


def test_it_follows_a_velocity_in_the_frame_of_its_heading(flight: Flight) -> None:
    flight.goal = Goal([0.0, 0.0, 1.0], heading=math.pi / 2)
    flight.fly(8.0)
    flight.goal = flight.goal.moving((0.5, 0.0, 0.1), 0.0)
    flight.fly(8.0)
    assert list(flight.body.linear_velocity) == pytest.approx([0.0, 0.5, 0.1], abs=0.02)
    flight.goal = flight.goal.at_rest()
    flight.fly(8.0)
    assert list(flight.body.linear_velocity) == pytest.approx([0.0, 0.0, 0.0], abs=5e-3)


def test_it_holds_its_place_in_the_wind_by_leaning_into_it(flight: Flight) -> None:
    flight.fly(8.0)
    flight.simulation.wind.mean = [4.0, 0.0, 0.0]
    flight.fly(15.0)
    assert flight.fly(7.0) < 0.1, "gusts of 10 %"
    pitches = []
    for _ in range(70):
        flight.fly(0.1)
        _, y, _, w = flight.body.orientation
        pitches.append(2 * math.atan2(y, w))
    # Its wind force, 0.2 1/s * mass of base_link * 4 m/s, and the drag of the rotors.
    drag = 0.2 * 1.46 * 4.0 + 4 * 8.06428e-05 * HOVER * 4.0
    assert sum(pitches) / len(pitches) == pytest.approx(-math.atan(drag / 1.5 / GRAVITY), rel=0.1)


def test_equal_seeds_give_equal_flights_in_the_wind() -> None:
    hashes = []
    for _ in range(2):
        flight = Flight()
        flight.simulation.wind.mean = [1.0, 2.0, 0.0]
        flight.fly(2.0)
        hashes.append(flight.simulation.state_hash())
    assert hashes[0] == hashes[1]


def test_a_goal_does_not_sink_below_the_ground() -> None:
    goal = Goal([0.0, 0.0, 0.5]).moving((0.0, 0.0, -1.0), 0.0)
    assert goal.after(2.0, lowest=0.1).position[2] == 0.1
