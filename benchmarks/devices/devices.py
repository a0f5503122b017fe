#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compare creating and serializing the message of a Gazebo plugin with copying the serialized bytes once.

The codec's bytes are converted to a Python object here, a second copy that the node does not make.
"""

import statistics
import time
from collections.abc import Callable

import numpy as np

import bubblesim
from bubblesim import _core
from bubblesim.gazebo_plugins.sensors.block_laser import cloud_of_returns, directions
from bubblesim.gazebo_plugins.sensors.camera import image_message
from bubblesim.gazebo_plugins.sensors.laser import laser_scan

ROUNDS, REPEATS = 15, 40
HEADER = {"stamp": {"secs": 1, "nsecs": 2}, "frame_id": "sensor"}
MODEL = """\
<sdf version="1.9"><model name="post"><static>true</static><pose>0 0 1 0 0 0</pose><link name="link">
  <sensor name="camera" type="camera"><camera><horizontal_fov>1</horizontal_fov>
    <image><width>640</width><height>480</height></image><clip><near>0.1</near><far>50</far></clip></camera></sensor>
  <sensor name="laser" type="lidar"><lidar><scan><horizontal><samples>720</samples><min_angle>-1.57</min_angle>
    <max_angle>1.57</max_angle></horizontal></scan><range><min>0.1</min><max>30</max></range></lidar></sensor>
  <sensor name="lidar" type="lidar"><lidar><scan><horizontal><samples>1800</samples><min_angle>-3.14</min_angle>
    <max_angle>3.14</max_angle></horizontal><vertical><samples>16</samples><min_angle>-0.26</min_angle>
    <max_angle>0.26</max_angle></vertical></scan><range><min>0.1</min><max>30</max></range></lidar></sensor>
</link></model></sdf>
"""


def microseconds(action: Callable[[], object]) -> float:
    """Return the median over rounds of the mean time of a call."""
    means = []
    for _ in range(ROUNDS):
        start = time.perf_counter()
        for _ in range(REPEATS):
            action()
        means.append((time.perf_counter() - start) / REPEATS)
    return statistics.median(means) * 1e6


def report(name: str, message_type: str, make: Callable[[], dict[str, object]]) -> None:
    """Print a line."""
    encoded = np.frombuffer(_core.messages.encode(message_type, {"header": HEADER, **make()}), np.uint8)
    making = microseconds(make)
    whole = microseconds(lambda: _core.messages.encode(message_type, {"header": HEADER, **make()}))
    copy = microseconds(encoded.copy)
    print(
        f"{name:24} {encoded.size:9} bytes  dict {making:8.1f} us  dict and bytes {whole:8.1f} us  copy {copy:8.1f} us"
    )


def main() -> None:
    """Measure all messages."""
    simulation = bubblesim.Simulation("ball")
    simulation.add_model(MODEL)
    image, scan, cloud = (simulation.object(f"/post/link/{name}").reading for name in ("camera", "laser", "lidar"))
    rays = directions(cloud)
    report("Image 640 x 480", "sensor_msgs/Image", lambda: image_message(image.rgb, "rgb8"))
    report("LaserScan 720", "sensor_msgs/LaserScan", lambda: laser_scan(scan))
    report("PointCloud2 16 x 1800", "sensor_msgs/PointCloud2", lambda: cloud_of_returns(cloud, rays, organized=True))


if __name__ == "__main__":
    main()
