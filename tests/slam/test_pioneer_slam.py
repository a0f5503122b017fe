# SPDX-License-Identifier: BSD-3-Clause
"""The Pioneer maps its room autonomously, with odometry that is 5 % off, at twice real time."""

import json
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
import pytest

from bubblesim.navigation.grid_map import GridMap
from room_truth import Comparison, compare, outlines, picture, truth_of
from ros_support import DEADLINE, REPOSITORY, SUPPORT, RosCore, start, stop_launch, wait_until

HEIGHTS = (0.1, 0.36)  # m, as in launch/pioneer_slam.launch
RADIUS = 0.3  # m, of the robot plus a margin


@dataclass(frozen=True)
class Outcome:
    """Results of a run."""

    seen: dict  # output of watch_mapping.py
    comparison: Comparison
    output: str  # of all nodes


Run = Callable[..., Outcome]


@pytest.fixture
def explore(roscore: RosCore, tmp_path: Path) -> Iterator[Run]:
    """Explore for some simulated seconds; call `first` before they are counted."""
    launched = []

    def run(seconds: float, first: Callable[[], None] = lambda: None) -> Outcome:
        log = tmp_path / "launch.log"
        command = ["roslaunch", "bubblesim", "pioneer_slam.launch", "explore:=true", "speed:=2"]
        with log.open("w") as output:
            launched.append(start(command, roscore.env, stdout=output, stderr=subprocess.STDOUT))
        wait_until(lambda: "/explore" in roscore.nodes(), "the nodes", 3 * DEADLINE)
        first()
        watch = [sys.executable, str(SUPPORT / "watch_mapping.py"), str(seconds), str(tmp_path / "map")]
        watched = subprocess.run(watch, env=roscore.env, capture_output=True, text=True, timeout=1000, check=False)
        assert watched.returncode == 0, watched.stderr + log.read_text()
        output = log.read_text() + watched.stderr  # before the work below takes the processor
        saved = np.load(tmp_path / "map.npz")
        grid = GridMap(saved["cells"], float(saved["resolution"]), (*map(float, saved["origin"]), 0.0))
        truth = truth_of(outlines(REPOSITORY / "scenes" / "pioneer.sdf", *HEIGHTS, leave_out="pioneer_p3dx"))
        cv2.imwrite(str(tmp_path / "map.png"), picture(grid, truth))
        seen = json.loads(watched.stdout.splitlines()[-1])
        return Outcome(seen, compare(grid, truth, (0.0, 0.0), RADIUS), output)

    yield run
    for process in launched:
        stop_launch(process)


def check(outcome: Outcome) -> None:
    """Check the conditions that hold at any time of a run."""
    seen = outcome.seen
    assert np.mean(seen["errors"]) <= 0.03
    assert np.max(seen["errors"]) <= 0.1
    assert outcome.comparison.wall_error <= 0.05
    assert seen["longest_gap"] == pytest.approx(0.1)  # no scan is lost in transport
    assert seen["lost"] == 0  # nor in the mapper
    assert "TF_OLD_DATA" not in outcome.output
    assert "dropped" not in outcome.output


def test_the_map_is_right_while_it_grows(explore: Run) -> None:
    outcome = explore(20.0)
    check(outcome)
    assert outcome.comparison.coverage > 0.5


@pytest.mark.long
def test_five_minutes_map_the_whole_room(explore: Run) -> None:
    outcome = explore(300.0)
    check(outcome)
    assert outcome.seen["done_at"] is not None
    assert outcome.comparison.coverage >= 0.95
    assert outcome.seen["arrived"]  # the number of goals does not matter
    assert all(outcome.seen["arrived"])


@pytest.mark.long
def test_a_simulation_that_starts_anew_is_mapped_anew(explore: Run, roscore: RosCore) -> None:
    def start_anew() -> None:
        roscore.echo("/go_to/path")  # it is driving
        for topic in ("/stopSimulation", "/startSimulation"):
            roscore.run("rostopic", "pub", "-1", topic, "std_msgs/Bool", "true")

    check(explore(20.0, start_anew))
