# SPDX-License-Identifier: BSD-3-Clause
"""Motion profiles: their limits, their ends, and the theory of time-optimal motions."""

import json
import math
from pathlib import Path
from typing import Any

import pytest

from node_support import run_script

pytest.importorskip("ruckig")


def results(folder: Path, body: str, until: float = 3.0, name: str = "script.py") -> Any:
    run = run_script(folder, body, "--strict", name=name, until=until)
    assert run.stderr == ""
    return json.loads(run.stdout)


def test_move_to_config_keeps_its_limits_and_takes_the_optimal_time(tmp_path: Path) -> None:
    code = """
        import json
        def sysCall_thread():
            sim.setStepping(True)
            states, start = [], sim.getSimulationTime()
            end = sim.moveToConfig(-1, [0, 0], None, None, [1, 1], [2, 2], [40, 40], [1, -0.5], None,
                                   lambda p, v, a, data: states.append([p, v, a, data]), 'mine')
            print(json.dumps([states, end, sim.getSimulationTime() - start]))
    """
    states, end, time = results(tmp_path, code)
    assert all(abs(v) <= 1 + 1e-9 for _, velocities, _, _ in states for v in velocities)
    assert all(abs(a) <= 2 + 1e-9 for _, _, accelerations, _ in states for a in accelerations)
    assert {data for *_, data in states} == {"mine"}
    assert end[0] == pytest.approx([1, -0.5])
    assert end[1] == pytest.approx([0, 0], abs=1e-9)
    # s / v + v / a + a / j (trapezoidal velocity with a limited jerk)
    theory = 1 / 1 + 1 / 2 + 2 / 40
    assert len(states) == math.ceil(theory / 0.05)
    assert end[3] == pytest.approx(theory - len(states) * 0.05, abs=1e-6)  # the time left, not positive
    assert time == pytest.approx((len(states) - 1) * 0.05)


def test_move_to_config_takes_a_table_and_ends_when_the_callback_returns_true(tmp_path: Path) -> None:
    code = """
        function sysCall_thread()
            local count = 0
            local given = {pos = {0}, targetPos = {1}, maxVel = {1}, maxAccel = {10}, maxJerk = {100}}
            given.callback = function(data) count = count + 1 return count == 4 end
            local ended = sim.moveToConfig(given)
            print('[' .. count .. ',' .. ended.pos[1] .. ']')
        end
    """
    count, position = results(tmp_path, code, name="script.lua")
    assert count == 4
    assert 0 < position < 1


def test_joints_move_without_a_callback(tmp_path: Path) -> None:
    code = """
        import json
        def sysCall_thread():
            joint = sim.getObject('/Steering')
            sim.moveToConfig({'joints': [joint], 'targetPos': [0.5], 'maxVel': [1], 'maxAccel': [5], 'maxJerk': [50]})
            for _ in range(10):
                sim.step()
            result = sim.rmlMoveToJointPositions([joint], -1, None, None, [1], [5], [50], [-0.2], None)
            for _ in range(10):
                sim.step()
            print(json.dumps([sim.getJointPosition(joint), result[0], result[1]]))
    """
    file = tmp_path / "script.py"
    run = run_script(tmp_path, code, "--strict", scene="tricycle", target="/Tricycle", until=5)
    assert file.exists()
    assert run.stderr == ""
    position, code_of_result, end = json.loads(run.stdout)
    assert position == pytest.approx(-0.2, abs=0.01)
    assert (code_of_result, end) == (0, [pytest.approx(-0.2)])


def test_move_to_pose_goes_straight(tmp_path: Path) -> None:
    code = """
        import json, math
        def sysCall_thread():
            start = [0, 0, 0, 0, 0, 0, 1]
            target = [1, 2, 0, 0, 0, math.sin(0.5), math.cos(0.5)]
            poses = []
            metric = sim.moveToPose(-1, start, [1], [10], [100], target, lambda p, *_: poses.append(p), None,
                                    [1, 1, 1, 0.1])
            free = sim.moveToPose(-1, start, [1, 1, 1, 1], [10] * 4, [100] * 4, target, None)
            print(json.dumps([poses, metric, free]))
    """
    poses, (end, left), (free_end, _) = results(tmp_path, code, until=6)
    assert end == pytest.approx([1, 2, 0, 0, 0, math.sin(0.5), math.cos(0.5)])
    assert free_end == pytest.approx(end)
    assert left <= 0
    for x, y, z, *_, qz, _qw in poses:
        assert y == pytest.approx(2 * x)
        assert z == 0
        assert 2 * math.asin(qz) == pytest.approx(x, abs=1e-9)  # one radian on the way to x = 1


def test_ruckig_step_by_step(tmp_path: Path) -> None:
    code = """
        import json
        def sysCall_init():
            h = sim.ruckigPos(1, 0.01, -1, [0, 0, 0], [1, 1, 10], [1], [1, 0])
            states = []
            while True:
                result, state, _ = sim.ruckigStep(h, 0.01)
                states.append(state)
                if result != 0:
                    break
            sim.ruckigRemove(h)
            v = sim.rmlVel(1, 0.01, -1, [0, 0, 0], [2, 20], [1], [1])
            time = 0
            while True:
                result, state, _ = sim.rmlStep(v, 0.01)
                time += 0.01
                if result != 0:
                    break
            print(json.dumps([result, states[-1], max(s[1] for s in states), len(states), time, state[1]]))
    """
    result, last, fastest, count, time, speed = results(tmp_path, code)
    assert result == 1
    assert last == pytest.approx([1, 0, 0], abs=1e-9)
    # s / v + v / a + a / j does not fit, since the full velocity is never reached: 2 sqrt(s / a) and a bit for the jerk
    assert 2.0 < 0.01 * count < 2.2
    assert fastest < 1
    assert time == pytest.approx(1 / 2 + 2 / 20, abs=0.011)  # v / a + a / j
    assert speed == pytest.approx(1)


def test_what_waits_is_only_for_threads(tmp_path: Path) -> None:
    body = "sim.moveToConfig(-1, [0], None, None, [1], [1], [1], [1], None, None)"
    run = run_script(tmp_path, f"def sysCall_init():\n    {body}\n", "--strict")
    assert "sim.moveToConfig is only allowed in sysCall_thread" in run.stderr


def test_impossible_motions_are_errors(tmp_path: Path) -> None:
    code = """
        def sysCall_init():
            try:
                sim.ruckigPos(1, 0.01, -1, [0, 0], [1, 1, 1], [1], [1, 0])
            except ValueError as error:
                print(error)
            try:
                sim.ruckigPos(1, 0.01, -1, [0, 0, 0], [1, 1, 1], [1], [1, 5])
            except ValueError as error:
                print(error)
    """
    run = run_script(tmp_path, code, "--strict")
    first, second = run.stdout.splitlines()
    assert first == "1 axes need 3 numbers, found 2"
    assert second.startswith("there is no such motion: ")


def test_motions_of_older_versions_end_where_they_are_sent(tmp_path: Path) -> None:
    code = """
        import json
        def sysCall_thread():
            sim.setStepping(True)
            joint, mover, goal = sim.createJoint(sim.joint_revolute), sim.createDummy(0.1), sim.createDummy(0.1)
            sim.moveToJointPositions([joint], [0.4], 2)
            sim.moveToPosition(mover, -1, [0.2, 0, 0], [0, 0, 0.5], 1)
            first = sim.getObjectPose(mover)
            sim.setObjectPose(goal, [0, 0.2, 0, 0, 0, 0, 1])
            sim.moveToObject(mover, goal, 3, 1, 1)
            print(json.dumps([sim.getJointPosition(joint), first, sim.getObjectPose(mover)]))
    """
    joint, first, last = results(tmp_path, code)
    assert joint == pytest.approx(0.4)
    assert first == pytest.approx([0.2, 0, 0, 0, 0, math.sin(0.25), math.cos(0.25)])
    assert last == pytest.approx([0, 0.2, 0, 0, 0, 0, 1], abs=1e-9)


def test_a_prepared_motion_is_advanced_step_by_step(tmp_path: Path) -> None:
    code = """
        import json
        def sysCall_init():
            rest = [0, 0, 0]
            motion = sim.rmlPos(1, 0.05, -1, rest, [1, 2, 40], [1], [0.5, 0])
            time = 0
            result = 0
            while result == 0:
                result, state, _ = sim.rmlStep(motion, 0.05)
                time += 0.05
            sim.rmlRemove(motion)
            speed = sim.ruckigVel(1, 0.05, -1, rest, [2, 40], [1], [1])
            count, done = 0, 0
            while done == 0:
                done, velocity, _ = sim.ruckigStep(speed, 0.05)
                count += 1
            sim.ruckigRemove(speed)
            print(json.dumps([result, time, state, velocity, count]))
    """
    result, time, state, velocity, count = results(tmp_path, code)
    assert (result, state[0]) == (1, pytest.approx(0.5))
    # It does not get to the largest velocity: 2 sqrt(s / a) without the limit of the jerk, a / j more with it.
    assert 2 * math.sqrt(0.5 / 2) - 0.05 <= time <= 2 * math.sqrt(0.5 / 2) + 2 * 2 / 40 + 0.05
    assert velocity[1] == pytest.approx(1)
    assert count in (11, 12)  # v / a + a / j = 0.55 s, the end of a step
