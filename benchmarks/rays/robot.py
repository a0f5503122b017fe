# SPDX-License-Identifier: BSD-3-Clause
"""Measure steps of robots whose cameras and lidars all have subscribers, relative to real time.

    python benchmarks/rays/robot.py [--steps N]

Every sensor measures in each step of 50 ms. A step includes the messages and their bytes, as the node creates them,
without sending them: image, depth image and point cloud of each RGB-D camera of 640 x 480 pixels, all points and the
middle ring of a lidar of 16 x 1800 rays. The robots stand among 200 boxes with one light that casts shadows.
"""

from __future__ import annotations

import argparse
import statistics
import tempfile
import time
from typing import Any

import numpy as np

import bubblesim
from bubblesim import _core
from bubblesim.gazebo_plugins.robots import GazeboPlugins

STEP = 0.05  # s
CAMERA = """<sensor name="{0}" type="rgbd_camera"><topic>{0}</topic><pose>{1}</pose><camera>
    <horizontal_fov>1.2</horizontal_fov><image><width>640</width><height>480</height></image>
    <clip><near>0.05</near><far>100</far></clip></camera></sensor>"""
LIDAR = """<sensor name="lidar" type="gpu_lidar"><topic>scan</topic><pose>0 0 0.1 0 0 0</pose><lidar><scan>
    <horizontal><samples>1800</samples><min_angle>-3.1416</min_angle><max_angle>3.1416</max_angle></horizontal>
    <vertical><samples>16</samples><min_angle>-0.26</min_angle><max_angle>0.26</max_angle></vertical></scan>
    <range><min>0.05</min><max>30</max></range></lidar></sensor>"""
ROBOTS = {
    "one RGB-D camera": CAMERA.format("front", "0 0 0 0 0 0"),
    "two RGB-D cameras and a lidar": CAMERA.format("left", "0 0 0 0 0 0.5")
    + CAMERA.format("right", "0 0 0 0 0 -0.5")
    + LIDAR,
}


class Subscribers:
    """Stands for the bridge: encodes each message as for a topic with subscribers."""

    def __init__(self) -> None:
        """Begin without topics."""
        self._types: list[str] = []
        self._sizes: dict[int, int] = {}

    def now(self) -> tuple[int, int]:
        """Return the time."""
        return 1, 0

    def advertise(self, _topic: str, message_type: str, _qos: object) -> int:
        """Return the handle of a new topic."""
        self._types.append(message_type)
        return len(self._types) - 1

    def wants_messages(self, _publisher: int) -> bool:
        """Return true: each topic has subscribers."""
        return True

    def publish(self, publisher: int, message: Any) -> None:
        """Encode a message; the bytes stay in C++, as in the node."""
        if publisher not in self._sizes:
            self._sizes[publisher] = len(_core.messages.encode(self._types[publisher], message))
        _core.messages.truncations(self._types[publisher], message)

    @property
    def bytes(self) -> int:
        """Return the size of one message of each topic."""
        return sum(self._sizes.values())


def scene(sensors: str) -> str:
    """Return the scene as SDFormat."""
    random = np.random.default_rng(3)
    boxes = ""
    for i in range(200):
        distance, angle, heading = random.uniform(3, 18), *random.uniform(-3.1, 3.1, 2)
        x, y = distance * np.cos(angle), distance * np.sin(angle)
        wide, deep = random.uniform(0.2, 1.5, 2)
        boxes += f"""<model name="Box{i}"><static>true</static><pose>{x} {y} 0.5 0 0 {heading}</pose><link name="l">
            <collision name="c"><geometry><box><size>{wide} {deep} 1</size></box></geometry></collision></link>
            </model>"""
    return f"""<sdf version="1.9"><world name="w"><light name="sun" type="directional">
        <direction>0.4 0.3 -1</direction><cast_shadows>true</cast_shadows></light>
        <model name="Ground"><static>true</static><link name="l"><collision name="c"><geometry><plane/></geometry>
        </collision></link></model>{boxes}
        <model name="Robot"><static>true</static><pose>0 0 0.5 0 0 0</pose><link name="base">
        <visual name="body"><geometry><cylinder><radius>0.2</radius><length>0.4</length></cylinder></geometry></visual>
        {sensors}</link></model></world></sdf>"""


def measure(sensors: str, steps: int) -> tuple[float, float, int]:
    """Return the median time of a step in s, its CPU time, and the size of its messages."""
    with tempfile.NamedTemporaryFile("w", suffix=".sdf") as file:
        file.write(scene(sensors))
        file.flush()
        simulation = bubblesim.Simulation(file.name)
    subscribers = Subscribers()
    plugins = GazeboPlugins(simulation, subscribers)
    times, used = [], []
    for _ in range(steps):
        start, cpu = time.perf_counter(), time.process_time()
        plugins.actuate()
        simulation.step()
        plugins.publish()
        times.append(time.perf_counter() - start)
        used.append(time.process_time() - cpu)
    return statistics.median(times), statistics.median(used), subscribers.bytes


def main() -> None:
    """Measure all robots."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--steps", type=int, default=100)
    steps = parser.parse_args().steps
    for name, sensors in ROBOTS.items():
        elapsed, used, size = measure(sensors, steps)
        print(
            f"{name}: {elapsed * 1e3:.2f} ms a step, {used * 1e3:.2f} ms of CPU time, {size / 1e6:.1f} MB of messages;"
            f" {STEP / elapsed:.1f} x real time, {STEP / used:.1f} x on one core"
        )


if __name__ == "__main__":
    main()
