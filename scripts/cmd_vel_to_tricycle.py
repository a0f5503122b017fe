#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Control a tricycle with velocities.

Subscribes to cmd_vel (Twist); publishes steering, speed and odom (Odometry, integrated from the commands).
Parameters: ~wheelbase, ~wheel_radius (m), ~max_steering (rad), ~max_speed (rad/s of the front wheel), ~patience (s
without a command after which the tricycle stops), ~odom_frame, ~base_frame, ~publish_tf.
"""

import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C while modules are loaded shows no traceback

import dataclasses
import sys
import threading

import rospy
import tf2_ros
from geometry_msgs.msg import Quaternion, TransformStamped, Twist
from nav_msgs.msg import Odometry
from std_msgs.msg import Float32

from bubblesim.controllers.planar_motion import Pose2D, Velocity, moved
from bubblesim.controllers.tricycle_drive import FrontWheel, Tricycle, front_wheel, velocity
from bubblesim.geometry.rotations import quaternion_of_heading
from bubblesim.nodes.run_node import run_node, run_ros_program

RATE = 20.0  # Hz, of the odometry


class CmdVelToTricycle:
    """Converts each Twist to a command for the front wheel; stops the wheel when no Twist arrives."""

    def __init__(self, tricycle: Tricycle) -> None:
        """Create publishers and subscribers; the node must be initialised."""
        self._tricycle = tricycle
        self._timeout = float(rospy.get_param("~patience", 0.6))
        self._odom_frame = str(rospy.get_param("~odom_frame", "odom"))
        self._base_frame = str(rospy.get_param("~base_frame", "base_link"))
        self._lock = threading.Lock()  # callbacks and the timer run in separate threads
        self._wheel = FrontWheel(steering=0.0, speed=0.0)
        self._pose = Pose2D()
        self._received_at: float | None = None  # time of the last command, None when stopped
        self._moved_at = rospy.get_time()
        self._steering = rospy.Publisher("steering", Float32, queue_size=1)
        self._speed = rospy.Publisher("speed", Float32, queue_size=1)
        self._odometry = rospy.Publisher("odom", Odometry, queue_size=10)
        self._transforms = tf2_ros.TransformBroadcaster() if rospy.get_param("~publish_tf", False) else None
        rospy.Subscriber("cmd_vel", Twist, self._on_velocity, queue_size=1)
        rospy.Timer(rospy.Duration.from_sec(1.0 / RATE), lambda event: self._on_time(), reset=True)

    def _on_velocity(self, twist: Twist) -> None:
        with self._lock:
            try:
                wheel = front_wheel(self._tricycle, Velocity(twist.linear.x, twist.angular.z), self._wheel.steering)
            except ValueError as error:
                rospy.logwarn_throttle(5.0, f"cmd_vel: {error}; ignored")
                return
            self._move()
            self._received_at = rospy.get_time()
            self._command(wheel)

    def _on_time(self) -> None:
        with self._lock:
            self._move()
            if self._received_at is not None and not 0.0 <= rospy.get_time() - self._received_at <= self._timeout:
                self._received_at = None
                self._command(FrontWheel(self._wheel.steering, 0.0))
            self._publish()

    def _command(self, wheel: FrontWheel) -> None:
        self._wheel = wheel
        self._steering.publish(wheel.steering)
        self._speed.publish(wheel.speed)

    def _move(self) -> None:
        """Integrate the pose up to the current time."""
        now = rospy.get_time()
        dt, self._moved_at = max(0.0, now - self._moved_at), now  # simulation time jumps back at a restart
        self._pose = moved(self._pose, velocity(self._tricycle, self._wheel), dt)

    def _publish(self) -> None:
        message = Odometry()
        message.header.stamp = rospy.Time.from_sec(self._moved_at)
        message.header.frame_id = self._odom_frame
        message.child_frame_id = self._base_frame
        message.pose.pose.position.x = self._pose.x
        message.pose.pose.position.y = self._pose.y
        message.pose.pose.orientation = Quaternion(*quaternion_of_heading(self._pose.heading))
        now = velocity(self._tricycle, self._wheel)
        message.twist.twist.linear.x = now.linear
        message.twist.twist.angular.z = now.angular
        self._odometry.publish(message)
        if self._transforms is not None:
            transform = TransformStamped(header=message.header, child_frame_id=self._base_frame)
            transform.transform.translation.x = self._pose.x
            transform.transform.translation.y = self._pose.y
            transform.transform.rotation = message.pose.pose.orientation
            self._transforms.sendTransform(transform)


def read_tricycle() -> Tricycle:
    """Read the tricycle from the parameters of the node."""
    defaults = dataclasses.asdict(Tricycle())
    return Tricycle(**{name: float(rospy.get_param(f"~{name}", value)) for name, value in defaults.items()})


def main() -> int:
    """Run the node until shutdown; return 2 for invalid parameters."""
    return run_node("cmd_vel_to_tricycle", __doc__, lambda: CmdVelToTricycle(read_tricycle()))


if __name__ == "__main__":
    sys.exit(run_ros_program(main))
