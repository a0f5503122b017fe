# SPDX-License-Identifier: BSD-3-Clause
"""Functions in Python that run in physics substeps: before each one, and for each pair of shapes that touch."""

import math

import pytest

import bubblesim
from bubblesim import _core

HALF_SECOND = 10  # steps


def test_a_function_is_called_before_each_substep_until_it_is_removed() -> None:
    simulation = bubblesim.Simulation("ball")
    calls: list[tuple[float, float]] = []
    call = _core.SubstepCall(simulation.world, lambda time, duration: calls.append((time, duration)))
    simulation.step()
    assert calls == [(pytest.approx(0.005 * i), 0.005) for i in range(10)]
    simulation.reset()
    simulation.step()
    assert len(calls) == 20
    call.remove()
    simulation.step()
    assert len(calls) == 20


def test_an_error_of_the_function_ends_the_step() -> None:
    simulation = bubblesim.Simulation("ball")

    def fail(time: float, duration: float) -> None:
        raise ValueError("broken")

    call = _core.SubstepCall(simulation.world, fail)
    with pytest.raises(RuntimeError, match="called before substeps failed: ValueError: broken"):
        simulation.step()
    call.remove()
    simulation.step()


def test_a_contact_filter_decides_which_links_collide() -> None:
    heights = []
    for answer in (True, False, "no bool"):
        simulation = bubblesim.Simulation("ball")
        pairs: set[tuple[str, str]] = set()

        def collide(first: int, second: int, world=simulation.world, pairs=pairs, answer=answer) -> object:  # type: ignore[no-untyped-def]
            pairs.add((world.path(first), world.path(second)))
            return answer

        _core.set_contact_filter(simulation.world, collide)
        simulation.step(HALF_SECOND)
        simulation.reset()  # keeps the filter
        simulation.step(HALF_SECOND)
        heights.append(simulation.world.pose(simulation.object("/Ball").handle)[2])
        assert pairs == {("/Ball/link", "/Ramp/link")} or ("/Ball/link", "/Floor/link") in pairs
    assert heights[0] == heights[2] > 0.1
    assert heights[1] == pytest.approx(0.4 - 9.81 / 2 * 0.5**2, abs=0.02)  # it falls freely through the ramp


def test_without_a_filter_the_contacts_are_those_of_before() -> None:
    alone, filtered = bubblesim.Simulation("ball"), bubblesim.Simulation("ball")
    _core.set_contact_filter(filtered.world, lambda first, second: True)
    alone.step(HALF_SECOND)
    filtered.step(HALF_SECOND)
    assert filtered.state_hash() == alone.state_hash()
    _core.set_contact_filter(filtered.world, None)
    alone.step(HALF_SECOND)
    filtered.step(HALF_SECOND)
    assert filtered.state_hash() == alone.state_hash()


def test_a_contact_filter_gives_pairs_their_friction() -> None:
    places = []
    for friction in (0.0, 1.0, None, -1.0):
        simulation = bubblesim.Simulation("ball")
        _core.set_contact_filter(simulation.world, lambda first, second, friction=friction: (True, friction))
        simulation.step(2 * HALF_SECOND)
        places.append(simulation.world.pose(simulation.object("/Ball").handle)[0])
    assert places[0] != pytest.approx(places[1], abs=0.01)  # without friction it slides down the ramp, with it rolls
    assert places[2] == places[3]  # the surfaces' own


def test_a_joint_that_was_added_moves_what_is_below_it() -> None:
    world = bubblesim.Simulation("ball").world
    joint, below = world.add_joint("hinge", "revolute"), world.add_dummy("tip")
    world.set_pose(below, [1, 0, 0, 0, 0, 0, 1])
    world.set_parent(below, joint)
    world.set_joint_position(joint, math.pi / 2)
    assert list(world.pose(below)[:3]) == pytest.approx([0, 1, 0])
    world.set_joint_limits(joint, -1, 1)
    world.set_joint_position(joint, 3)
    assert world.joint_position(joint) == 1
    assert world.joint_limits(joint) == (-1, 1)
    with pytest.raises(ValueError, match="of the type 'screw' cannot be added"):
        world.add_joint("screw", "screw")
    with pytest.raises(ValueError, match="the lower one must not be above"):
        world.set_joint_limits(joint, 1, 0)
    with pytest.raises(ValueError, match="has the limits of its file"):
        world.set_joint_limits(world.find("/Ball", -1, 0), 0, 1)
    world.remove_dummy(joint)
    assert world.parent(below) == -1
