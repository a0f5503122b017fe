# SPDX-License-Identifier: BSD-3-Clause
"""Paths, against geometry."""

import json
import math
from pathlib import Path
from typing import Any

import pytest

from bubblesim.scripting.api.sim import path_points
from node_support import run_script


def results(folder: Path, code: str, until: float = 0.1) -> Any:
    run = run_script(folder, code, "--strict", until=until)
    assert run.stderr == ""
    return json.loads(run.stdout)


CORNER = "[0,0,0, 0,0,0,1,  2,0,0, 0,0,0,1,  2,1,0, 0,0,0,1]"


def test_a_straight_path_has_its_points_as_custom_data(tmp_path: Path) -> None:
    code = f"""
        import json
        def sysCall_init():
            path = sim.createPath({CORNER}, 0, 31, 0)
            data = sim.unpackDoubleTable(sim.readCustomDataBlock(path, 'PATH'))
            control = sim.unpackDoubleTable(sim.readCustomDataBlock(path, 'PATHCTRLPTS'))
            lengths, total = sim.getPathLengths([x for i in range(31) for x in data[7 * i:7 * i + 3]], 3)
            end = sim.getPositionOnPath(path, 1.0)
            print(json.dumps([data, control, lengths, total, sim.getPathLength(path), end]))
    """
    data, control, lengths, total, length, last = results(tmp_path, code)
    assert len(data) == 7 * 31
    assert len(control) == 21
    assert total == length == pytest.approx(3)
    assert lengths[10] == pytest.approx(1)
    assert last == pytest.approx([2, 1, 0])
    # x points along the path: quaternions of no rotation, and of a quarter turn about z.
    assert data[3:7] == pytest.approx([0, 0, 0, 1])
    assert data[-4:] == pytest.approx([0, 0, math.sqrt(0.5), math.sqrt(0.5)])


def test_configurations_between_and_nearest_places(tmp_path: Path) -> None:
    code = """
        import json
        def sysCall_init():
            path, lengths = [0, 0, 0,  2, 0, 0,  2, 1, 0], [0, 2, 3]
            straight = sim.getPathInterpolatedConfig(path, lengths, 2.5)
            curved = sim.getPathInterpolatedConfig(path, lengths, 2, {'type': 'quadraticBezier', 'strength': 1.0})
            cyclic = sim.getPathInterpolatedConfig([3, -3], [0, 1], 0.5, None, [1])
            nearest = sim.getClosestPosOnPath(path, lengths, [3, 0.5, 0])
            print(json.dumps([straight, curved, cyclic, nearest, sim.resamplePath(path, lengths, 4)]))
    """
    straight, curved, cyclic, nearest, resampled = results(tmp_path, code)
    assert straight == pytest.approx([2, 0.5, 0])
    # From (1, 0) by the corner (2, 0) to (2, 0.5); the corner is at 2/3 of the curve's parameter.
    t = 1 / 1.5
    assert curved == pytest.approx([(1 - t) ** 2 * 1 + 2 * t * (1 - t) * 2 + t * t * 2, t * t * 0.5, 0])
    assert abs(cyclic[0]) == pytest.approx(math.pi)  # the shorter way
    assert nearest == pytest.approx(2.5)
    assert resampled == pytest.approx([0, 0, 0, 1, 0, 0, 2, 0, 0, 2, 1, 0])


def test_quaternions_between_have_length_1() -> None:
    turn = [0.0, 0.0, math.sin(0.5), math.cos(0.5)]
    half = path_points.mixed([0.0, 0.0, 0.0, 1.0], turn, 0.5, [path_points.QUATERNION] * 4)
    assert half == pytest.approx([0, 0, math.sin(0.25), math.cos(0.25)])


def test_an_object_follows_a_path(tmp_path: Path) -> None:
    code = f"""
        import json
        def sysCall_thread():
            path, dummy = sim.createPath({CORNER}, 0, 31, 0), sim.createDummy(0.1)
            start = sim.getSimulationTime()
            left = sim.followPath(dummy, path, 3, 0, 1.5)
            print(json.dumps([sim.getObjectPosition(dummy), sim.getSimulationTime() - start, left]))
    """
    position, time, left = results(tmp_path, code, until=3)
    assert position == pytest.approx([2, 1, 0])
    assert time == pytest.approx(3 / 1.5 - 0.05)
    assert left == pytest.approx(0, abs=1e-9)


def test_what_is_no_path_is_an_error(tmp_path: Path) -> None:
    run = run_script(tmp_path, "def sysCall_init():\n    sim.getPathLength(sim.getObject('.'))\n", "--strict")
    assert "/Ball is not a path: it has no custom data 'PATH'" in run.stderr


def test_old_paths_have_places_by_their_share_of_the_length(tmp_path: Path) -> None:
    code = f"""
        import json
        def sysCall_init():
            path = sim.createPath({CORNER}, 0, 31, 0)
            sim.setPathTargetNominalVelocity(path, 0.5)
            sim.setPathPosition(path, 1.25)
            share = sim.getClosestPositionOnPath(path, [1.5, -1, 0])
            angles = sim.getOrientationOnPath(path, 1)
            old = sim.createPath(1)
            sim.insertPathCtrlPoints(old, 0, 0, 2, [0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 3, 0, 0, 0, 0, 1, 0, 0, 0, 0])
            print(json.dumps([sim.getPathPosition(path), share, angles, sim.getPathLength(old)]))
    """
    position, share, angles, length = results(tmp_path, code)
    assert position == 1.25
    assert share == pytest.approx(1.5 / 3)
    assert angles == pytest.approx([0, 0, math.pi / 2])
    assert length == pytest.approx(3)
