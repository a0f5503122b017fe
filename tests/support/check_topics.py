#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Waits for a message on each topic that a node publishes; prints what is wrong with each, as JSON.

Arguments: the names of nodes. Values are finite but for those of scans, clouds and depth images without a hit;
quaternions have length 1; frames are those of /tf or of the robot's links; stamps are not older than a second when they
come; an IMU at rest measures gravity.
"""

import json
import math
import sys
import time
from collections.abc import Iterator
from xml.etree import ElementTree

import rosgraph
import rospy
import rostopic
import tf2_ros
import yaml

LONGEST_WAIT = 30.0  # s of wall time
OLDEST = 1.0  # s
SECONDS_OF_ODOMETRY = 1.0
MAY_BE_INFINITE = {"ranges", "intensities", "range", "range_max", "max_vel", "min_vel", "effort"}
EVENTS = ("/bubblesim/drawings", "/diagnostics", "/feedback", "/result", "/rosout")  # no message, or a rare one
UNUSED_FRAMES = {"", "world", "map"}  # of messages of the simulator itself


def values(message, path: str = "") -> Iterator[tuple[str, object]]:
    """Yield all members of a message, also of those within."""
    for name in message.__slots__:
        value = getattr(message, name)
        place = f"{path}.{name}" if path else name
        yield place, value
        for index, each in enumerate(value if isinstance(value, list | tuple) else [value]):
            if hasattr(each, "__slots__") and not hasattr(each, "to_sec"):
                yield from values(each, f"{place}[{index}]" if isinstance(value, list | tuple) else place)


def numbers(value) -> list[float]:
    if isinstance(value, float):
        return [value]
    return [each for each in value if isinstance(each, float)] if isinstance(value, list | tuple) else []


def problems(message, arrival: float, frames: set[str], oldest: float) -> Iterator[str]:
    for place, value in values(message):
        name = place.rpartition(".")[2]
        if name not in MAY_BE_INFINITE and not all(map(math.isfinite, numbers(value))):
            yield f"{place} is not finite"
        if any(map(math.isnan, numbers(value))):
            yield f"{place} is not a number"
        if getattr(value, "_type", "") == "geometry_msgs/Quaternion":
            length = math.hypot(value.x, value.y, value.z, value.w)
            if abs(length - 1) > 1e-6 and not place.startswith("orientation"):
                yield f"{place} has the length {length}"
        if name == "header" and not place.startswith("status"):
            if value.frame_id.lstrip("/") not in frames | UNUSED_FRAMES:
                yield f"{place} has the frame {value.frame_id}, which is not in /tf"
            if value.stamp and arrival - value.stamp.to_sec() > oldest:
                yield f"{place} has the time {value.stamp.to_sec()} and came at {arrival}"
    yield from problems_of_kind(message)


def problems_of_kind(message) -> Iterator[str]:
    kind = message._type
    if kind == "sensor_msgs/Imu":
        force = message.linear_acceleration
        if abs(math.hypot(force.x, force.y, force.z) - 9.8) > 1.0:
            yield f"measures {force}"
    elif kind == "sensor_msgs/LaserScan":
        seen = [each for each in message.ranges if not math.isinf(each)]
        if not all(message.range_min <= each <= message.range_max for each in seen):
            yield "has ranges outside of its limits"
        count = round((message.angle_max - message.angle_min) / message.angle_increment) + 1
        if abs(len(message.ranges) - count) > 1:
            yield f"has {len(message.ranges)} ranges for {count} angles"
    elif kind == "sensor_msgs/JointState":
        if not len(message.name) == len(message.position) == len(message.velocity):
            yield "has another number of positions or velocities than of names"
    elif kind == "sensor_msgs/NavSatFix":
        if not (abs(message.latitude) <= 90 and abs(message.longitude) <= 180 and message.latitude):
            yield f"is at {message.latitude}, {message.longitude}"
    elif kind == "nav_msgs/Odometry" and not all(message.pose.covariance[index] >= 0 for index in range(0, 36, 7)):
        yield "has a negative variance"


def main() -> None:
    nodes = set(rospy.myargv(sys.argv)[1:])
    rospy.init_node("check_topics")
    master = rosgraph.Master(rospy.get_name())
    topics = {topic for topic, publishers in master.getSystemState()[0] if nodes & set(publishers)}
    published = {topic for topic in topics if not topic.endswith(EVENTS)}
    buffer = tf2_ros.Buffer()
    tf2_ros.TransformListener(buffer)
    last: dict[str, tuple[object, float]] = {}  # messages with the times when they came, s

    def keep(message, topic: str) -> None:
        last[topic] = message, rospy.get_time()

    for topic in published:
        kind, _, _ = rostopic.get_topic_class(topic)
        rospy.Subscriber(topic, kind, keep, topic, queue_size=1)
    end = time.monotonic() + LONGEST_WAIT
    while published - last.keys() and time.monotonic() < end:
        time.sleep(0.1)
    time.sleep(SECONDS_OF_ODOMETRY)  # the frames of drives come with their odometry
    tree = yaml.safe_load(buffer.all_frames_as_yaml()) or {}
    links = ElementTree.fromstring(rospy.get_param("/robot_description", "<robot/>")).iterfind("link")
    frames = set(tree) | {each["parent"] for each in tree.values()} | {link.get("name", "") for link in links}
    found = {topic: ["has no message"] for topic in published - last.keys()}
    for topic, (message, arrival) in sorted(last.items()):
        if wrong := list(problems(message, arrival, frames, math.inf if topic == "/tf_static" else OLDEST)):
            found[topic] = wrong[:5]
    print(json.dumps({"topics": sorted(published), "problems": found}), flush=True)


if __name__ == "__main__":
    main()
