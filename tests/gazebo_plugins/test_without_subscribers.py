# SPDX-License-Identifier: BSD-3-Clause
"""Sensors without subscribers do not measure: cameras are the most expensive sensors of a robot."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from node_support import Node, write
from ros_peer import Message, Peer
from ros_support import RosCore, wait_until

ROBOT = """\
<sdf version="1.9" xmlns:bubblesim="https://bubblesim">
  <model name="robot">
    <static>true</static>
    <link name="eye">
      <sensor name="own" type="camera">
        <bubblesim:topic>own</bubblesim:topic>{camera}
      </sensor>
      <sensor name="plugged" type="camera">{camera}
        <plugin name="camera" filename="libgazebo_ros_camera.so"><cameraName>plugged</cameraName></plugin>
      </sensor>
      <sensor name="lidar" type="ray">
        <ray><scan><horizontal><samples>9</samples><min_angle>-1</min_angle><max_angle>1</max_angle></horizontal></scan>
          <range><min>0.1</min><max>9</max></range></ray>
        <plugin name="laser" filename="libgazebo_ros_laser.so"><topicName>scan</topicName></plugin>
      </sensor>
    </link>
  </model>
</sdf>
"""
CAMERA = """
        <camera><horizontal_fov>1</horizontal_fov><image><width>8</width><height>6</height></image>
          <clip><near>0.1</near><far>9</far></clip></camera>"""


@pytest.fixture(scope="module")
def peer(run: Callable[..., Any], tmp_path_factory: pytest.TempPathFactory) -> Peer:
    file: Path = write(tmp_path_factory.mktemp("robot") / "robot.sdf", ROBOT.replace("{camera}", CAMERA))
    peer: Peer = run(file).peer
    return peer


def measurements(peer: Peer, after: float = 0.0) -> tuple[float, int]:
    """Return the simulated time of the next report after a time, and the number of measurements until then."""

    def values(message: Message) -> dict[str, str]:
        return {pair["key"]: pair["value"] for status in message["status"] for pair in status["values"]}

    def is_later(message: Message) -> bool:
        return float(values(message).get("Simulation time (s)", 0)) > after

    report = values(peer.wait_for("/diagnostics", "diagnostic_msgs/DiagnosticArray", is_later, "a later report"))
    return float(report["Simulation time (s)"]), int(report["Measurements of sensors"])


def test_sensors_measure_only_while_somebody_listens(peer: Peer) -> None:
    time, before = measurements(peer)
    _, still = measurements(peer, after=time)
    assert still == before
    peer.next("/scan", "sensor_msgs/LaserScan")
    wait_until(lambda: measurements(peer)[1] > before, "the lidar's measurements")
    time, before = measurements(peer)
    later, after = measurements(peer, after=time + 1.0)
    # 20 steps per second, of the lidar only: two cameras with it would give three times as many.
    assert 0 < after - before < 2 * 20 * (later - time)


@pytest.mark.parametrize(
    ("scene", "infos", "image", "others"),
    [
        ("robot", ["/camera_info", "/plugged/camera_info"], "/own", 0),
        ("tricycle", ["/camera_info"], "/image", 20),  # its script reads the sonar in each step
    ],
)
def test_the_optics_of_a_camera_alone_do_not_have_it_measure(
    roscore: RosCore, tmp_path: Path, scene: str, infos: list[str], image: str, others: float
) -> None:
    """`others`: measurements of other sensors per simulated second."""
    file = write(tmp_path / "robot.sdf", ROBOT.replace("{camera}", CAMERA)) if scene == "robot" else scene
    with Node(roscore.env, tmp_path / "log", file), Peer(roscore, tmp_path / "received") as peer:
        for info in infos:
            peer.next(info, "sensor_msgs/CameraInfo")
        measurements(peer)
        time, before = measurements(peer)
        optics = [peer.next(info, count=5) for info in infos]
        later, after = measurements(peer)
        assert after - before == pytest.approx(others * (later - time), abs=1)
        assert all(message["width"] > 0 and message["K"][0] > 0 for message in optics)
        picture = peer.next(image, "sensor_msgs/Image")
        assert (picture["width"], picture["height"]) == (optics[0]["width"], optics[0]["height"])
