#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Drive the tricycle around obstacles: subscribes to /front_sonar, publishes /steering and /speed."""

import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C while modules are loaded shows no traceback

import argparse
import sys
import threading

import rospy
from std_msgs.msg import Float32

from bubblesim.controllers.tricycle_avoid import Command, TricycleAvoid, is_reading
from bubblesim.nodes.last_message import send_last
from bubblesim.nodes.run_node import run_ros_program

_PERIOD = 0.2  # s, between checks for missing sonar messages


class TricycleAvoidNode:
    """Updates the controller for each sonar message, and detects missing sonar messages."""

    def __init__(self) -> None:
        """Create publishers and subscribers; the node must be initialised."""
        self._controller = TricycleAvoid()
        self._lock = threading.Lock()  # callbacks and the timer run in separate threads
        self._ended = False
        self._last_update = rospy.get_time()
        self._steering = rospy.Publisher("/steering", Float32, queue_size=1)
        self._speed = rospy.Publisher("/speed", Float32, queue_size=1)
        rospy.Subscriber("/front_sonar", Float32, self._on_sonar, queue_size=10)
        rospy.Timer(rospy.Duration.from_sec(_PERIOD), lambda event: self._update(None), reset=True)
        rospy.on_shutdown(self._stop)

    def _on_sonar(self, message: Float32) -> None:
        if not is_reading(message.data):
            rospy.logwarn_throttle(5.0, f"/front_sonar: {message.data} is not a distance; ignored")
        self._update(message.data)

    def _update(self, distance: float | None) -> None:
        with self._lock:
            now = rospy.get_time()
            dt, self._last_update = now - self._last_update, now
            # The clock jumps if several of its messages arrive late at once: this is not a timeout of the sonar.
            command = self._controller.update(distance, min(dt, _PERIOD))
            if command is None or self._ended:
                return
            if self._controller.stopped:
                rospy.logwarn("no messages on /front_sonar: stopping until the next one")
            self._publish(command)

    def _publish(self, command: Command) -> None:
        self._steering.publish(command.steering)
        self._speed.publish(command.speed)

    def _stop(self) -> None:
        with self._lock:
            self._ended = True
        send_last((self._speed, Float32(0.0)))


def main() -> int:
    """Run the node until shutdown."""
    argparse.ArgumentParser(description=__doc__).parse_args(rospy.myargv(sys.argv)[1:])
    rospy.init_node("tricycle_avoid")
    TricycleAvoidNode()
    rospy.spin()
    return 0


if __name__ == "__main__":
    sys.exit(run_ros_program(main))
