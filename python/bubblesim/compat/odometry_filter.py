# SPDX-License-Identifier: BSD-3-Clause
"""The node ekf_localization_node: publishes odometry on odometry/filtered, and its transform. It is no Kalman filter.

It integrates the velocities of the odometry ~odom0 in the plane, with the yaw rate of the IMU ~imu0 if ~imu0_config
uses it, and passes them on. Parameters as of robot_localization: ~odom0, ~imu0, ~imu0_config, ~frequency (30 Hz),
~odom_frame, ~base_link_frame, ~world_frame, ~publish_tf. Further sensors have no effect.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import rospy
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu
from tf2_msgs.msg import TFMessage

from bubblesim.nodes.run_node import run_node

_YAW_RATE = 11  # its index in a configuration of robot_localization
_LONGEST = 1.0  # s between messages over which velocities are integrated
_KNOWN = ("odom0", "imu0", "odom0_config", "imu0_config")


@dataclass
class Pose:
    """A pose in the plane: m, rad."""

    x: float = 0.0
    y: float = 0.0
    heading: float = 0.0

    def move(self, forward: float, leftward: float, turning: float, duration: float) -> None:
        """Integrate constant velocities (m/s, rad/s) over a duration in s, exact on the arc for forward velocities."""
        middle = self.heading + turning * duration / 2
        half = turning * duration / 2
        chord = math.sin(half) / half if abs(half) > 1e-9 else 1.0
        self.x += chord * duration * (forward * math.cos(middle) - leftward * math.sin(middle))
        self.y += chord * duration * (forward * math.sin(middle) + leftward * math.cos(middle))
        self.heading = math.remainder(self.heading + turning * duration, 2 * math.pi)


class OdometryFilter:
    """Integrates with each message of the odometry."""

    def __init__(self) -> None:
        """Read the parameters, and subscribe."""
        self._odom_frame = str(rospy.get_param("~odom_frame", "odom"))
        self._base_frame = str(rospy.get_param("~base_link_frame", "base_link"))
        world = str(rospy.get_param("~world_frame", self._odom_frame))
        if world != self._odom_frame:
            raise ValueError(f"~world_frame is {world}: only that of the odometry, {self._odom_frame}, is supported")
        others = [name for name in rospy.get_param("~", {}) if name[-1:].isdigit() and name not in _KNOWN]
        rospy.loginfo("the velocities of ~odom0 are integrated; there is no Kalman filter here")
        if others:
            rospy.logwarn(f"without effect: {', '.join(sorted(others))}")
        self._publishes_transform = bool(rospy.get_param("~publish_tf", True))
        self._period = 1.0 / float(rospy.get_param("~frequency", 30.0))
        self._pose = Pose()
        self._yaw_rate: float | None = None
        self._time: float | None = None
        self._published = -math.inf
        self._odometry = rospy.Publisher("odometry/filtered", Odometry, queue_size=10)
        self._transforms = rospy.Publisher("/tf", TFMessage, queue_size=100)
        configuration = list(rospy.get_param("~imu0_config", []))
        if rospy.has_param("~imu0") and len(configuration) > _YAW_RATE and configuration[_YAW_RATE]:
            rospy.Subscriber(str(rospy.get_param("~imu0")), Imu, self._on_imu, queue_size=10)
        topic = rospy.get_param("~odom0", None)
        if topic is None:
            raise ValueError("~odom0, the topic of the odometry, is missing")
        rospy.Subscriber(str(topic), Odometry, self._on_odometry, queue_size=10)

    def _on_imu(self, message: Any) -> None:
        self._yaw_rate = message.angular_velocity.z

    def _on_odometry(self, message: Any) -> None:
        time = message.header.stamp.to_sec()
        if self._time is not None and time < self._time:  # the simulation was reset
            self._pose, self._published = Pose(), -math.inf
        duration = time - self._time if self._time is not None else 0.0
        self._time = time
        twist = message.twist.twist
        if self._yaw_rate is not None:
            twist.angular.z = self._yaw_rate
        if 0.0 < duration <= _LONGEST:
            self._pose.move(twist.linear.x, twist.linear.y, twist.angular.z, duration)
        if time < self._published + self._period * 0.99:
            return
        self._published = time
        self._publish(message)

    def _publish(self, message: Any) -> None:
        message.header.frame_id, message.child_frame_id = self._odom_frame, self._base_frame
        pose = message.pose.pose
        pose.position.x, pose.position.y, pose.position.z = self._pose.x, self._pose.y, 0.0
        pose.orientation.x = pose.orientation.y = 0.0
        pose.orientation.z, pose.orientation.w = math.sin(self._pose.heading / 2), math.cos(self._pose.heading / 2)
        self._odometry.publish(message)
        if self._publishes_transform:
            transform = TransformStamped(header=message.header, child_frame_id=self._base_frame)
            transform.transform.translation.x, transform.transform.translation.y = self._pose.x, self._pose.y
            transform.transform.rotation = pose.orientation
            self._transforms.publish(TFMessage([transform]))


def main() -> int:
    """Run the node until shutdown; return 2 for invalid parameters."""
    return run_node("ekf_localization_node", __doc__, OdometryFilter)
