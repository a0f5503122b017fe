#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measure what the messages of Gazebo plugins cost, compared with copying their bytes once."""

import statistics
import time
from collections.abc import Callable

import numpy as np
from bubblesim._core import reading_messages as make

import bubblesim
from bubblesim import _core

ROUNDS = 15
JOINTS = 12
HEADER = make.Header(make.Clock(), "sensor")
CHAIN = """
  <link name="link_{i}"><pose>0 0 {i} 0 0 0</pose><inertial><mass>1</mass></inertial></link>
  <joint name="joint_{i}" type="revolute"><parent>{parent}</parent><child>link_{i}</child>
    <axis><xyz>0 0 1</xyz></axis></joint>"""
MODEL = """\
<sdf version="1.9"><model name="post"><pose>0 0 1 0 0 0</pose><link name="link">
  <sensor name="camera" type="rgbd_camera"><camera><horizontal_fov>1</horizontal_fov>
    <image><width>640</width><height>480</height></image><clip><near>0.1</near><far>50</far></clip></camera></sensor>
  <sensor name="laser" type="lidar"><lidar><scan><horizontal><samples>720</samples><min_angle>-1.57</min_angle>
    <max_angle>1.57</max_angle></horizontal></scan><range><min>0.1</min><max>30</max></range></lidar></sensor>
  <sensor name="lidar" type="lidar"><lidar><scan><horizontal><samples>1563</samples><min_angle>-3.14</min_angle>
    <max_angle>3.14</max_angle></horizontal><vertical><samples>64</samples><min_angle>-0.26</min_angle>
    <max_angle>0.26</max_angle></vertical></scan><range><min>0.1</min><max>30</max></range></lidar></sensor>
  <sensor name="imu" type="imu"/>
</link>CHAIN</model></sdf>
"""


def microseconds(action: Callable[[], object]) -> float:
    """Return the median over rounds of the mean time of a call."""
    start = time.perf_counter()
    action()
    repeats = max(3, int(0.01 / (time.perf_counter() - start)))
    means = []
    for _ in range(ROUNDS):
        start = time.perf_counter()
        for _ in range(repeats):
            action()
        means.append((time.perf_counter() - start) / repeats)
    return statistics.median(means) * 1e6


def report(name: str, message_type: str, message: Callable[[], object]) -> None:
    """Print a line."""
    encoded = np.frombuffer(_core.messages.encode(message_type, message()), np.uint8)
    whole = microseconds(lambda: _core.messages.truncations(message_type, message()))
    copy = microseconds(encoded.copy)
    print(f"{name:24} {encoded.size:9} bytes  message and bytes {whole:8.1f} us  copy {copy:8.1f} us")


def main() -> None:
    """Measure all messages."""
    simulation = bubblesim.Simulation("sensors")
    parents = ["link", *(f"link_{i}" for i in range(JOINTS))]
    chain = "".join(CHAIN.format(i=i, parent=parents[i]) for i in range(JOINTS))
    simulation.add_model(MODEL.replace("CHAIN", chain))
    simulation.step()
    readings = (simulation.object(f"/post/link/{name}").reading for name in ("camera", "laser", "lidar", "imu"))
    image, scan, cloud, imu = readings
    joints = [simulation.object(f"/post/joint_{i}").handle for i in range(JOINTS)]
    pose, vector, variances = [1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 1.0], (0.1, 0.2, 0.3), (1e-3,) * 6
    motion = "base", pose, vector, vector, variances, variances
    report("Imu", "sensor_msgs/Imu", lambda: make.imu(HEADER, imu))
    report("JointState of 12", "sensor_msgs/JointState", lambda: make.joint_state(simulation.world, HEADER, joints))
    report("Odometry", "nav_msgs/Odometry", lambda: make.odometry(HEADER, *motion))
    report("LaserScan 720", "sensor_msgs/LaserScan", lambda: make.laser_scan(HEADER, scan))
    report("Image 640 x 480", "sensor_msgs/Image", lambda: make.color_image(HEADER, image))
    limits = 0.4, 5.0
    points = "sensor_msgs/PointCloud2"
    report("PointCloud2 640 x 480", points, lambda: make.camera_cloud(HEADER, image, limits, optical=True))
    report("PointCloud2 64 x 1563", points, lambda: make.lidar_cloud(HEADER, cloud, organized=True))


if __name__ == "__main__":
    main()
