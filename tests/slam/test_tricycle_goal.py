# SPDX-License-Identifier: BSD-3-Clause
"""A tricycle, which cannot turn in place, drives round the obstacles in its room on a map from files."""

import subprocess
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np
import pytest
import yaml

from ros_support import DEADLINE, REPOSITORY, RosCore, start, stop, wait_until

RESOLUTION = 0.1  # m
DRIVER = [
    "_turning_radius:=0.6",
    "_lookahead:=0.9",
    "_radius:=0.7",
    "_max_speed:=0.8",
    "_tolerance:=0.25",
    "_patience:=60",
]
GOAL = "{header: {frame_id: map}, pose: {position: {x: -3, y: -2}, orientation: {w: 1}}}"


def draw_room(folder: Path) -> Path:
    """Draw the room's walls and two obstacles as in the model walled_room."""
    shades = np.full((104, 104), 0, np.uint8)
    shades[2:-2, 2:-2] = 254
    for x, y, size in [(3.4, -1.2, 1.3), (-0.8, 3.2, 0.8), (1.6, -4.0, 1.2), (-4.0, -4.7, 2.0)]:
        left, right = (round((x + side * size / 2 + 5.2) / RESOLUTION) for side in (-1, 1))
        low, high = (round((y + side * size / 2 + 5.2) / RESOLUTION) for side in (-1, 1))
        shades[max(104 - high, 0) : 104 - low, max(left, 0) : right] = 0
    cv2.imwrite(str(folder / "room.pgm"), shades)
    description = f"image: room.pgm\nresolution: {RESOLUTION}\norigin: [-5.2, -5.2, 0]\nnegate: 0\n"
    (folder / "room.yaml").write_text(description + "occupied_thresh: 0.65\nfree_thresh: 0.196\n")
    return folder / "room.yaml"


@pytest.fixture
def arrivals(roscore: RosCore, tmp_path: Path) -> Iterator[Path]:
    """Run go_to.py with everything that it needs; its messages at the end of a goal go to the returned file."""
    roscore.set_param("/use_sim_time", True)
    arrived = tmp_path / "arrived"
    commands = [
        ["rosrun", "bubblesim", "sim", "tricycle_cmd_vel", "--speed", "3"],
        ["rosrun", "bubblesim", "map_server", str(draw_room(tmp_path))],
        ["rosrun", "tf2_ros", "static_transform_publisher", *("0" * 6), "map", "odom"],
        ["rosrun", "bubblesim", "go_to.py", *DRIVER],
    ]
    running = [start(command, roscore.env, stdout=subprocess.DEVNULL) for command in commands]
    with arrived.open("w") as output:
        running.append(start(["rostopic", "echo", "/go_to/arrived"], roscore.env, stdout=output))
    yield arrived
    for process in running:
        stop(process)


def test_a_tricycle_comes_to_a_goal_behind_it(arrivals: Path, roscore: RosCore, tmp_path: Path) -> None:
    wait_until(lambda: "/go_to/arrived" in roscore.state()["subscribers"], "the listener")
    wait_until(lambda: "/move_base_simple/goal" in roscore.state()["subscribers"], "go_to.py")
    wait_until(lambda: "/map" in roscore.state()["publishers"], "the map")
    with roscore.publishing("/move_base_simple/goal", "geometry_msgs/PoseStamped", GOAL):
        wait_until(lambda: "data: " in arrivals.read_text(), "the end of the drive", 6 * DEADLINE)
    assert "data: True" in arrivals.read_text()
    reported = roscore.run("rosservice", "call", "/sim_ros_interface/get_object_state", "{object: /Tricycle}")
    place = yaml.safe_load(reported)["pose"]["position"]
    assert (place["x"], place["y"]) == pytest.approx((-3.0, -2.0), abs=0.5)  # it coasts a little


def test_the_drawn_room_is_that_of_the_model() -> None:
    model = (REPOSITORY / "scenes" / "models" / "walled_room" / "model.sdf").read_text()
    for pose in ("3.4 -1.2", "-0.8 3.2", "1.6 -4", "-4 -4.7"):
        assert f"<pose>{pose} " in model
