# SPDX-License-Identifier: BSD-3-Clause
"""RViz with config/pioneer.rviz, on a virtual display, shows the Pioneer, all its sensor data, and its map."""

import re
import subprocess
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest
from PIL import Image

from display_support import Display
from ros_support import DEADLINE, RosCore, start, stop_launch, wait_until

TIMEOUT = 6 * DEADLINE  # software rendering is slow


@pytest.fixture
def display(roscore: RosCore) -> Iterator[Display]:
    with Display(roscore.env) as display:
        yield display


def view(picture: npt.NDArray[np.uint8]) -> npt.NDArray[np.int32]:
    """Return the part of RViz's window that shows the world, by the layout of the configuration."""
    return picture[65:765, 370:1180].astype(np.int32)


def missing(picture: npt.NDArray[np.uint8]) -> list[str]:
    """Return what the picture does not show."""
    world = view(picture)
    red, green, blue = world[..., 0], world[..., 1], world[..., 2]
    rows, columns = red.shape
    scan = (red > 230) & (green < 30) & (blue < 30)  # in the colour of the configuration
    cloud = (green > 120) & (np.minimum(red, blue) < 60)  # coloured by height: partly green to yellow
    free = (abs(red - green) < 8) & (abs(green - blue) < 8) & (red > 170) & (red < 215)  # of the map
    centre = world[rows // 2 - 30 : rows // 2 + 30, columns // 2 - 30 : columns // 2 + 30]
    robot = centre.max(axis=2) < 60  # in the middle: black on the map's grey
    image = picture[545:760, 10:335].astype(np.int32)  # bottom left; without an image it is black on white
    coloured = np.ptp(image, axis=2) > 20
    shown = {
        "image": coloured.sum() > 1000,
        "scan": scan.sum() > 500,
        "cloud": cloud.sum() > 300,
        "map": free.sum() > 50_000,
        "robot": robot.sum() > 150,
    }
    return [name for name, enough in shown.items() if not enough]


def test_rviz_shows_robot_scan_cloud_map_and_image(display: Display, roscore: RosCore, tmp_path: Path) -> None:
    for attempt in range(3):  # with OpenGL in software, RViz itself crashes now and then while it starts
        log = tmp_path / f"log{attempt}"
        with log.open("w") as output:
            command = ["roslaunch", "bubblesim", "pioneer_slam.launch", "rviz:=true"]
            launched = start(command, display.env, stdout=output, stderr=subprocess.STDOUT)
        try:
            if shows_all(display, roscore, log):
                return
        finally:
            stop_launch(launched)
    pytest.fail(f"RViz crashed {attempt + 1} times, see {log}")


def shows_all(display: Display, roscore: RosCore, log: Path) -> bool:
    """Wait until RViz shows everything; return False if it crashes."""
    screenshot = log.with_name("rviz.png")
    left: list[str] = []

    def has_crashed() -> bool:
        return bool(re.search(r"\[rviz-\d+\] process has died", log.read_text()))

    def complete() -> bool:
        picture = display.screenshot()
        Image.fromarray(picture).save(screenshot)
        left[:] = missing(picture)
        return not left

    def what_is_left() -> str:
        return f"RViz to show {left}, see {screenshot}; nodes: {roscore.nodes()}; {log.read_text()[-2000:]}"

    wait_until(lambda: has_crashed() or "/rviz" in roscore.nodes(), "RViz", TIMEOUT)
    wait_until(lambda: has_crashed() or complete(), what_is_left, TIMEOUT)
    return not has_crashed()
