#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Drives the tricycle around obstacles: /front_sonar in, /steering and /speed out."""

import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C while modules are loaded shows no traceback

import argparse
import sys
import threading
import time

import rospy
from std_msgs.msg import Float32

from bubblesim.controllers.tricycle_avoid import Command, TricycleAvoid, is_reading
from bubblesim.nodes.run_node import run_ros_program

_PERIOD = 0.2  # s, between looks for the sonar's silence


class TricycleAvoidNode:
    """Steps the controller once for each sonar message, and watches for the sonar's silence."""

    def __init__(self) -> None:
        """Connects the topics; the node must be initialised."""
        self._controller = TricycleAvoid()
        self._lock = threading.Lock()  # messages and the timer come on threads of their own
        self._ended = False
        self._last_update = rospy.get_time()
        self._steering = rospy.Publisher("/steering", Float32, queue_size=1)
        self._speed = rospy.Publisher("/speed", Float32, queue_size=1)
        rospy.Subscriber("/front_sonar", Float32, self._on_sonar, queue_size=10)
        rospy.Timer(rospy.Duration.from_sec(_PERIOD), lambda event: self._update(None), reset=True)
        rospy.on_shutdown(self._stop)

    def _on_sonar(self, message: Float32) -> None:
        if not is_reading(message.data):
            rospy.logwarn_throttle(5.0, f"/front_sonar: {message.data} is no distance, ignored")
        self._update(message.data)

    def _update(self, distance: float | None) -> None:
        with self._lock:
            now = rospy.get_time()
            dt, self._last_update = now - self._last_update, now
            # A clock whose messages come late and then all at once jumps: that is no silence of the sonar.
            command = self._controller.update(distance, min(dt, _PERIOD))
            if command is None or self._ended:
                return
            if self._controller.stopped:
                rospy.logwarn("/front_sonar is silent: stopping until it is back")
            self._publish(command)

    def _publish(self, command: Command) -> None:
        self._steering.publish(command.steering)
        self._speed.publish(command.speed)

    def _stop(self) -> None:
        with self._lock:
            self._ended = True
            self._speed.publish(0.0)
        time.sleep(0.1)  # rospy sends from another thread, which ends with the node


def main() -> int:
    """Runs the node until it is told to stop."""
    argparse.ArgumentParser(description=__doc__).parse_args(rospy.myargv(sys.argv)[1:])
    rospy.init_node("tricycle_avoid")
    TricycleAvoidNode()
    rospy.spin()
    return 0


if __name__ == "__main__":
    sys.exit(run_ros_program(main))
