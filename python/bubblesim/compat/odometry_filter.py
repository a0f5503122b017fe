# SPDX-License-Identifier: BSD-3-Clause
"""The node ekf_localization_node: publishes odometry on odometry/filtered, and its transform. It is no Kalman filter.

It integrates the velocities of the odometry ~odom0 in the plane, with the yaw rate of the IMU ~imu0 if ~imu0_config
uses it, on a slope by its roll and pitch if these are used, and passes them on. Parameters as of robot_localization:
~odom0, ~imu0, ~imu0_config, ~frequency (30 Hz), ~odom_frame, ~base_link_frame, ~world_frame, ~publish_tf. Further
sensors have no effect. Each message counts, so that a node that gets little processor time is late, but loses nothing.
"""

from __future__ import annotations

import math
import threading
from collections import deque
from dataclasses import dataclass
from typing import Any

import rospy
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu
from tf2_msgs.msg import TFMessage

from bubblesim.geometry.poses import about_axis
from bubblesim.geometry.rotations import heading_of, product
from bubblesim.nodes.run_node import run_node

_ROLL, _PITCH, _YAW_RATE = 3, 4, 11  # their indices in a configuration of robot_localization
_LONGEST = 1.0  # s between messages over which velocities are integrated; s that odometry waits for the IMU
_MOST_READINGS = 10_000  # of an IMU, without odometry: 50 s at 200 Hz
_KNOWN = ("odom0", "imu0", "odom0_config", "imu0_config")


@dataclass
class Pose:
    """A pose in the plane: m, rad."""

    x: float = 0.0
    y: float = 0.0
    heading: float = 0.0

    def move(self, forward: float, leftward: float, turn: float) -> None:
        """Move by lengths in m of arcs that turn by an angle in rad."""
        half = turn / 2
        middle = self.heading + half
        chord = math.sin(half) / half if abs(half) > 1e-9 else 1.0
        self.x += chord * (forward * math.cos(middle) - leftward * math.sin(middle))
        self.y += chord * (forward * math.sin(middle) + leftward * math.cos(middle))
        self.heading = math.remainder(self.heading + turn, 2 * math.pi)


class YawTurns:
    """The yaw that the rates of an IMU turn by, from one odometry message to the next."""

    def __init__(self, *, tilts: bool) -> None:
        """Know no turn until the second message.

        :param tilts: whether roll and pitch of the IMU's orientation are used: the rates about all its axes count.
        """
        self._tilts = tilts
        self._latest: float | None = None  # s
        self._readings: deque[tuple[float, float, float]] = deque(maxlen=_MOST_READINGS)  # s, rad, rad/s
        self._before: list[float] | None = None  # the last orientation
        self.rate = 0.0  # rad/s, the last one integrated

    def add(self, message: Any) -> None:
        """Add a sensor_msgs/Imu."""
        time, rates = message.header.stamp.to_sec(), message.angular_velocity
        if self._latest is not None and time < self._latest:  # the simulation was reset
            self._readings.clear()
            self._latest = None
        step = time - self._latest if self._latest is not None else 0.0
        self._latest = time
        turn = self._turn(message.orientation, (rates.x, rates.y, rates.z), step if step <= _LONGEST else 0.0)
        self._readings.append((time, turn, rates.z))

    def _turn(self, orientation: Any, rates: tuple[float, float, float], step: float) -> float:
        """Return the change of the yaw, rad.

        The rates, rad/s, turn the last orientation to where they predict it to be. What the prediction turns further
        about the vertical than the orientations differ is what the IMU's own yaw lacks: drift and noise of the rates.
        So a robot that stands on its end, where roll and yaw are the same, does not add up noise.
        """
        now = [orientation.x, orientation.y, orientation.z, orientation.w]
        before, self._before = self._before, now
        if not self._tilts or not any(now):
            return rates[2] * step
        if before is None or step == 0.0:
            return 0.0
        angle = math.hypot(*rates) * step
        predicted = product(before, about_axis(rates, angle)) if angle > 0.0 else before
        further = product(predicted, [*(-part for part in now[:3]), now[3]])
        turn = heading_of(*now) - heading_of(*before) + 2 * math.atan2(further[2], further[3])
        return math.remainder(turn, math.tau)

    def is_used(self) -> bool:
        """Return whether there was a reading."""
        return self._latest is not None

    def is_there(self, time: float) -> bool:
        """Return whether all readings up to a time in s are there; without any, nobody waits for them."""
        return self._latest is None or self._latest >= time

    def turn_until(self, time: float) -> float:
        """Return the angle in rad of the readings up to a time in s, since the last call."""
        turn = 0.0
        while self._readings and self._readings[0][0] <= time:
            _, part, self.rate = self._readings.popleft()
            turn += part
        return turn


class OdometryFilter:
    """Integrates the messages of the odometry in the order of their times with those of the IMU."""

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
        self._waiting: deque[Any] = deque()  # odometry for whose time the IMU's messages have not come yet
        self._lock = threading.Lock()  # each subscriber has a thread of its own
        self._time: float | None = None
        self._published = -math.inf
        self._odometry = rospy.Publisher("odometry/filtered", Odometry, queue_size=10)
        self._transforms = rospy.Publisher("/tf", TFMessage, queue_size=100)
        configuration = list(rospy.get_param("~imu0_config", []))
        self._yaw = YawTurns(tilts=all(configuration[_ROLL : _PITCH + 1]) and len(configuration) > _PITCH)
        if rospy.has_param("~imu0") and len(configuration) > _YAW_RATE and configuration[_YAW_RATE]:
            rospy.Subscriber(str(rospy.get_param("~imu0")), Imu, self._on_imu)
        topic = rospy.get_param("~odom0", None)
        if topic is None:
            raise ValueError("~odom0, the topic of the odometry, is missing")
        rospy.Subscriber(str(topic), Odometry, self._on_odometry)

    def _on_imu(self, message: Any) -> None:
        with self._lock:
            self._yaw.add(message)
            self._integrate_waiting()

    def _on_odometry(self, message: Any) -> None:
        with self._lock:
            self._waiting.append(message)
            self._integrate_waiting()

    def _integrate_waiting(self) -> None:
        newest = self._waiting[-1].header.stamp.to_sec() if self._waiting else 0.0
        while self._waiting:
            time = self._waiting[0].header.stamp.to_sec()
            if not self._yaw.is_there(time) and 0.0 <= newest - time <= _LONGEST:
                return
            self._integrate(self._waiting.popleft())

    def _integrate(self, message: Any) -> None:
        time = message.header.stamp.to_sec()
        if self._time is not None and time < self._time:  # the simulation was reset
            self._pose, self._published = Pose(), -math.inf
        duration = time - self._time if self._time is not None else 0.0
        self._time = time
        twist = message.twist.twist
        turn = twist.angular.z * duration
        if self._yaw.is_used():
            turn = self._yaw.turn_until(time)
            twist.angular.z = self._yaw.rate
        if 0.0 <= duration <= _LONGEST:  # 0 of the first one: the robot may have turned before it
            self._pose.move(twist.linear.x * duration, twist.linear.y * duration, turn)
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
