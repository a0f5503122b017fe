# SPDX-License-Identifier: BSD-3-Clause
"""Velocity commands on the topic cmd_vel."""

import threading

import rospy
from geometry_msgs.msg import Twist, TwistStamped

from bubblesim.controllers.base_velocity import STANDING, BaseVelocity
from bubblesim.nodes.last_message import send_last


class TwistCommands:
    """Publishes velocities, and a final zero velocity when the node ends.

    Parameters of the node: ~stamped (TwistStamped instead of Twist), ~frame_id.
    """

    def __init__(self) -> None:
        """Advertise the topic; the node must be initialised."""
        self._stamped = bool(rospy.get_param("~stamped", False))
        self._frame_id = str(rospy.get_param("~frame_id", ""))
        self._publisher = rospy.Publisher("cmd_vel", TwistStamped if self._stamped else Twist, queue_size=1)
        self._lock = threading.Lock()  # _end runs on another thread
        self._ended = False
        self._standing = True
        rospy.on_shutdown(self._end)

    def publish(self, velocity: BaseVelocity) -> None:
        """Publish one command."""
        with self._lock:
            self._standing = velocity == STANDING
            if not self._ended:
                self._publisher.publish(self._message(velocity))

    def follow(self, velocity: BaseVelocity) -> None:
        """Publish a command, but zero velocity only once, so that other nodes can drive while this one is idle."""
        if velocity != STANDING or not self._standing:
            self.publish(velocity)

    def _end(self) -> None:
        with self._lock:
            self._ended = True
        send_last((self._publisher, self._message(STANDING)))

    def _message(self, velocity: BaseVelocity) -> Twist | TwistStamped:
        return velocity_message(velocity, stamped=self._stamped, frame_id=self._frame_id)


def velocity_message(velocity: BaseVelocity, *, stamped: bool, frame_id: str = "") -> Twist | TwistStamped:
    """Return a velocity as a message, with the time of now if it is stamped."""
    twist = Twist()
    twist.linear.x = velocity.forward
    twist.linear.y = velocity.left
    twist.angular.z = velocity.turning
    if not stamped:
        return twist
    message = TwistStamped(twist=twist)
    message.header.stamp = rospy.Time.now()
    message.header.frame_id = frame_id
    return message
