#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Drives a robot 2 m ahead and turns it by 180 degrees, by its odometry; prints what it has moved in truth, as JSON."""

import json
import math
import sys
import time
from collections.abc import Callable

import rospy
from gazebo_msgs.msg import ModelStates
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry

PERIOD = 0.02  # s of wall time between commands
STILL = 0.002  # m or rad, less than what counts
LONGEST_REST = 10.0  # s


def heading(orientation) -> float:
    return 2 * math.atan2(orientation.z, orientation.w)


class Drive:
    def __init__(self, model: str, commands: str, odometry: str) -> None:
        self.model = model
        self.odometry = None
        self.truth = None
        self.commands = rospy.Publisher(commands, Twist, queue_size=1)
        rospy.Subscriber(odometry, Odometry, self.on_odometry, queue_size=1)
        rospy.Subscriber("/gazebo/model_states", ModelStates, self.on_truth, queue_size=1)

    def on_odometry(self, message) -> None:
        self.odometry = message.pose.pose

    def on_truth(self, message) -> None:
        if self.model in message.name:
            self.truth = message.pose[message.name.index(self.model)]

    def send(self, linear: float, angular: float) -> None:
        twist = Twist()
        twist.linear.x, twist.angular.z = linear, angular
        self.commands.publish(twist)
        time.sleep(PERIOD)

    def rest(self, each: Callable[[], None] = lambda: None) -> None:
        """Stand for a second, and until the odometry does so, too: on a busy machine its filter is late."""
        end = rospy.get_time() + LONGEST_REST
        reported, until = self.reported(), rospy.get_time() + 1.0
        while rospy.get_time() < min(until, end):
            self.send(0.0, 0.0)
            each()
            if math.dist(self.reported(), reported) > STILL:
                reported, until = self.reported(), rospy.get_time() + 1.0

    def reported(self) -> tuple[float, float, float]:
        return self.odometry.position.x, self.odometry.position.y, heading(self.odometry.orientation)

    def ahead(self, speed: float, distance: float) -> tuple[float, float]:
        """Return the distances by odometry and in truth."""
        starts = self.odometry, self.truth
        while self.distance(starts[0], self.odometry) < distance:
            self.send(speed, 0.0)
        self.rest()
        return self.distance(starts[0], self.odometry), self.distance(starts[1], self.truth)

    def turn(self, speed: float, angle: float) -> tuple[float, float]:
        """Return the angles by odometry and in truth."""
        sums = [0.0, 0.0]
        last = [heading(self.odometry.orientation), heading(self.truth.orientation)]

        def add() -> None:
            for index, pose in enumerate((self.odometry, self.truth)):
                now = heading(pose.orientation)
                sums[index] += math.remainder(now - last[index], 2 * math.pi)
                last[index] = now

        while abs(sums[0]) < angle:
            self.send(0.0, speed)
            add()
        self.rest(add)
        return abs(sums[0]), abs(sums[1])

    @staticmethod
    def distance(start, end) -> float:
        return math.hypot(end.position.x - start.position.x, end.position.y - start.position.y)


def main() -> None:
    model, commands, odometry, linear, angular = rospy.myargv(sys.argv)[1:]
    rospy.init_node("drive_robot")
    drive = Drive(model, commands, odometry)
    while drive.odometry is None or drive.truth is None or drive.commands.get_num_connections() == 0:
        time.sleep(0.05)
    begin = rospy.get_time()
    drive.rest()  # it settles
    distances = drive.ahead(float(linear), 2.0)
    angles = drive.turn(float(angular), math.pi)
    print(json.dumps({"distances": distances, "angles": angles, "took": rospy.get_time() - begin}), flush=True)


if __name__ == "__main__":
    main()
