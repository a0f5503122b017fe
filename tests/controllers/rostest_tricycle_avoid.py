#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The node scripts/tricycle_avoid.py, tested on its topics. Started by tricycle_avoid.test."""

import math
import queue
import sys
import time
import unittest

import rospy
import rostest
from std_msgs.msg import Float32


class TricycleAvoidTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        rospy.init_node("test_tricycle_avoid")
        cls.steering, cls.speed = queue.Queue(), queue.Queue()
        rospy.Subscriber("/steering", Float32, lambda message: cls.steering.put(message.data))
        rospy.Subscriber("/speed", Float32, lambda message: cls.speed.put(message.data))
        cls.sonar = rospy.Publisher("/front_sonar", Float32, queue_size=1)
        while cls.sonar.get_num_connections() == 0 and not rospy.is_shutdown():
            time.sleep(0.05)

    def publish_until(self, distance: float, values: queue.Queue, expected: float) -> None:
        """Publish a distance repeatedly until the expected value arrives, limited by rostest's time limit."""
        while not rospy.is_shutdown():
            self.sonar.publish(distance)
            try:
                if math.isclose(values.get(timeout=0.1), expected, abs_tol=1e-6):
                    return
            except queue.Empty:
                pass

    def test_steers_away_when_something_is_near(self) -> None:
        self.publish_until(0.5, self.steering, math.radians(70.0))

    def test_reaches_full_speed_without_an_echo(self) -> None:
        self.publish_until(math.inf, self.speed, 1.0)

    def test_stops_when_the_sonar_is_silent(self) -> None:
        self.publish_until(0.5, self.speed, 0.5)
        while self.speed.get(timeout=20.0) != 0.0:
            pass


if __name__ == "__main__":
    rostest.rosrun("bubblesim", "tricycle_avoid", TricycleAvoidTest, sys.argv)
