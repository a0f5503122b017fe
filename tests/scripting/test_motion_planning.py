# SPDX-License-Identifier: BSD-3-Clause
"""simOMPL: paths around obstacles, whose states are checked with the scene's own collisions."""

from pathlib import Path

import pytest

from node_support import REFUSED, in_init, run_script
from remote_support import RemoteNode

pytest.importorskip("ompl", reason="scripts/setup --with planning installs OMPL")

# A disc of 0.2 m, and a wall of 2 m between its start and its goal.
ROOM = """
disc = sim.createPrimitiveShape(sim.primitiveshape_cylinder, [0.4, 0.4, 0.2])
wall = sim.createPrimitiveShape(sim.primitiveshape_cuboid, [0.1, 2, 1])
sim.setObjectPosition(disc, [19, 0, 50])
sim.setObjectPosition(wall, [20, 0, 50])
"""
SEARCH = """
task = simOMPL.createTask('way')
space = simOMPL.createStateSpace('2d', simOMPL.StateSpaceType.position2d, disc, [18, -3], [22, 3], 1)
simOMPL.setStateSpace(task, [space])
simOMPL.setAlgorithm(task, simOMPL.Algorithm.RRTConnect)
simOMPL.setCollisionPairs(task, [disc, wall])
simOMPL.setStartState(task, [19, 0])
simOMPL.setGoalState(task, [21, 0])
simOMPL.setStateValidityCheckingResolution(task, 0.005)
simOMPL.setup(task)
"""
FREE = """
assert len(path) % 2 == 0 and len(path) >= 6
points = list(zip(path[::2], path[1::2]))
for a, b in [(points[0], (19, 0)), (points[-1], (21, 0))]:
    assert math.dist(a, b) < 1e-6
for (x0, y0), (x1, y1) in zip(points, points[1:]):
    for i in range(101):
        x, y = x0 + (x1 - x0) * i / 100, y0 + (y1 - y0) * i / 100
        away = math.hypot(max(abs(x - 20) - 0.05, 0), max(abs(y) - 1, 0))
        assert away > 0.2 - 0.03, (x, y)  # the states that are checked are 36 mm apart
"""


def check(folder: Path, body: str) -> str:
    """Run `body` in sysCall_init; an error fails the test. Return what it printed."""
    run = run_script(folder, f"import math\n{REFUSED}{in_init(body)}", "--strict")
    assert (run.stderr, run.returncode) == ("", 0)
    return run.stdout


def test_a_path_leads_around_a_wall_and_the_scene_stays_as_it_was(tmp_path: Path) -> None:
    body = f"""{ROOM}{SEARCH}
assert simOMPL.solve(task, 20)
simOMPL.simplifyPath(task)
path = simOMPL.getPath(task)
{FREE}
length = sum(math.dist(a, b) for a, b in zip(points, points[1:]))
assert length >= 2 * math.hypot(1 - 0.05, 1.2 - 0.03)
assert all(abs(a - b) < 1e-12 for a, b in zip(sim.getObjectPosition(disc), [19, 0, 50]))
simOMPL.interpolatePath(task, 40)
path = simOMPL.getPath(task)
assert simOMPL.getPathStateCount(task, path) >= 40
assert simOMPL.getPathState(task, path, 1) == path[:2]
assert simOMPL.getReversedPath(task, path)[:2] == path[-2:]
assert simOMPL.isStateValid(task, [19, 0]) and not simOMPL.isStateValid(task, [20, 0])
assert simOMPL.readState(task) == [19, 0]
"""
    check(tmp_path, body)


def test_there_is_no_path_through_a_closed_wall(tmp_path: Path) -> None:
    body = f"""{ROOM}
wall = sim.createPrimitiveShape(sim.primitiveshape_cuboid, [0.1, 8, 1])
sim.setObjectPosition(wall, [20, 0, 50]){SEARCH}
assert simOMPL.compute(task, 0.5) == (False, [])
assert not simOMPL.hasSolution(task) and simOMPL.getPath(task) == []
assert 'has no path' in refused(simOMPL.simplifyPath, task)
"""
    check(tmp_path, body)


@pytest.mark.parametrize(
    ("kind", "start", "goal"),
    [
        ("position3d", [19, 0, 50], [21, 0, 50]),
        ("pose2d", [19, 0, 0], [21, 0, 1]),
        ("pose3d", [19, 0, 50, 0, 0, 0, 1], [21, 0, 50, 0, 0, 1, 0]),
        ("dubins", [19, 0, 0], [21, 0, 1]),
    ],
)
def test_spaces_have_states_of_their_kind(tmp_path: Path, kind: str, start: list[float], goal: list[float]) -> None:
    """States between those that were checked may touch a corner, but a smaller disc does not."""
    body = f"""{ROOM}
def task_of(moved):
    task = simOMPL.createTask('way')
    space = simOMPL.createStateSpace('s', simOMPL.StateSpaceType.{kind}, moved, [18, -3, 49], [22, 3, 51], 1)
    simOMPL.setStateSpace(task, [space])
    simOMPL.setCollisionPairs(task, [moved, wall])
    return task
task = task_of(disc)
smaller = task_of(sim.createPrimitiveShape(sim.primitiveshape_cylinder, [0.34, 0.34, 0.14]))
simOMPL.setStateValidityCheckingResolution(task, 0.005)
simOMPL.setStartState(task, {start})
simOMPL.setGoalState(task, {goal})
assert 'must have {len(start)} numbers' in refused(simOMPL.setGoalState, task, [1])
found, path = simOMPL.compute(task, 20, -1, 30)
size = {len(start)}
assert found and len(path) % size == 0 and len(path) >= 30 * size
assert math.dist(path[:size], {start}) < 1e-6 and math.dist(path[-size:], {goal}) < 1e-6
for i in range(0, len(path), size):
    assert simOMPL.isStateValid(smaller, path[i:i + size])
"""
    check(tmp_path, body)


def test_joints_and_a_callback_decide_in_lua(tmp_path: Path) -> None:
    code = """
        function sysCall_init()
          local joints = {}
          for i = 1, 2 do joints[i] = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0) end
          local task = simOMPL.createTask('arm')
          simOMPL.setAlgorithm(task, simOMPL.Algorithm.RRTConnect)
          local spaces = {}
          for i = 1, 2 do
            spaces[i] = simOMPL.createStateSpace('j', simOMPL.StateSpaceType.joint_position, joints[i], {-3}, {3}, 1)
          end
          simOMPL.setStateSpace(task, spaces)
          simOMPL.setStartState(task, {-1, 0})
          simOMPL.setGoalState(task, {1, 0})
          simOMPL.setStateValidityCheckingResolution(task, 0.002)
          simOMPL.setStateValidationCallback(task, function(state)
            assert(math.abs(sim.getJointPosition(joints[1]) - state[1]) < 1e-9)
            return math.abs(state[1]) > 0.2 or math.abs(state[2]) > 1
          end)
          local found, path = simOMPL.compute(task, 20, -1, 50)
          assert(found and #path >= 100)
          for i = 1, #path, 2 do assert(math.abs(path[i]) > 0.15 or math.abs(path[i + 1]) > 0.95) end
          assert(sim.getJointPosition(joints[1]) == 0)
        end
    """
    run = run_script(tmp_path, code, "--strict", name="script.lua")
    assert (run.stderr, run.returncode) == ("", 0)


def test_an_error_of_the_callback_ends_the_search_and_is_the_script_s(tmp_path: Path) -> None:
    body = f"""{ROOM}{SEARCH}
def judge(state): raise LookupError('judged')
simOMPL.setStateValidationCallback(task, judge)
assert refused(simOMPL.solve, task, 30) == 'judged'
assert 'there is no task 99' in refused(simOMPL.solve, 99)
assert 'is not an algorithm' in refused(simOMPL.setAlgorithm, task, 99)
assert 'below the upper ones' in refused(simOMPL.createStateSpace, 's', 1, disc, [1, 1], [0, 2])
"""
    check(tmp_path, body)


def test_remote_programs_plan_paths(tmp_path: Path) -> None:
    with RemoteNode(tmp_path, "--speed", "max", scene="ball") as node:
        client = node.client()
        sim, planner = client.require("sim"), client.require("simOMPL")
        disc = sim.createPrimitiveShape(sim.primitiveshape_cylinder, [0.4, 0.4, 0.2])
        wall = sim.createPrimitiveShape(sim.primitiveshape_cuboid, [0.1, 2, 1])
        sim.setObjectPosition(disc, [19, 0, 50])
        sim.setObjectPosition(wall, [20, 0, 50])
        task = planner.createTask("way")
        space = planner.createStateSpace("2d", planner.StateSpaceType.position2d, disc, [18, -3], [22, 3], 1)
        planner.setStateSpace(task, [space])
        planner.setAlgorithm(task, planner.Algorithm.RRTConnect)
        planner.setCollisionPairs(task, [disc, wall])
        planner.setStartState(task, [19, 0])
        planner.setGoalState(task, [21, 0])
        planner.setup(task)
        assert planner.solve(task, 20)
        planner.simplifyPath(task, 1)
        path = planner.getPath(task)
        assert path[:2] == pytest.approx([19, 0])
        assert path[-2:] == pytest.approx([21, 0])


def test_one_of_several_goals_is_reached_and_written(tmp_path: Path) -> None:
    body = f"""{ROOM}{SEARCH}
simOMPL.setVerboseLevel(task, 0)
simOMPL.setGoalStates(task, [[20, 0]])  # in the wall
simOMPL.addGoalState(task, [19, 2])
assert simOMPL.solve(task, 20)
assert simOMPL.hasExactSolution(task) and not simOMPL.hasApproximateSolution(task)
path = simOMPL.getPath(task)
assert math.dist(path[-2:], (19, 2)) < 1e-6
simOMPL.writeState(task, path[-2:])
assert math.dist(sim.getObjectPosition(disc), (19, 2, 50)) < 1e-6
simOMPL.destroyTask(task)
simOMPL.destroyStateSpace(space)
assert 'task' in refused(simOMPL.solve, task, 1)
"""
    check(tmp_path, body)
