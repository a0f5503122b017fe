#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Explore a map: publish goals for the node go_to.py until there are no unknown areas left.

Subscribes to map and go_to/arrived; publishes move_base_simple/goal, and ~done (Bool, latched) at the end.
Parameters: ~map_frame, ~base_frame, ~radius (m, of the robot), ~shortest (m, minimum length of a frontier).
"""

import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C while modules are loaded shows no traceback

from bubblesim.program import users_packages

users_packages.leave_out()

import sys
import threading

import rospy
import tf2_ros
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import OccupancyGrid
from std_msgs.msg import Bool

from bubblesim.navigation.exploration import Explorer
from bubblesim.navigation.grid_map import GridMap
from bubblesim.navigation.path_planning import Footprint
from bubblesim.navigation.planar import Point, pose_of
from bubblesim.nodes.run_node import run_node, run_ros_program

SPARE = 0.1  # m: margin so that go_to.py can plan a path to each viewpoint
TIMEOUT = 5  # consecutive maps without a goal after which the exploration is complete


class Explore:
    """Selects a goal for each new map, and when the robot has arrived."""

    def __init__(self) -> None:
        """Create publishers and subscribers; the node must be initialised."""
        self._map_frame = str(rospy.get_param("~map_frame", "map"))
        self._base_frame = str(rospy.get_param("~base_frame", "base_link"))
        radius = float(rospy.get_param("~radius", 0.25)) + SPARE
        self._explorer = Explorer(Footprint(radius, radius), float(rospy.get_param("~shortest", 0.2)))
        self._lock = threading.Lock()  # callbacks run in separate threads
        self._without_goal = 0  # consecutive maps
        self._mapped_at = rospy.Time()  # time stamp of the last map
        self._transforms = tf2_ros.Buffer()
        self._listener = tf2_ros.TransformListener(self._transforms)
        # Latched: the first goal may be published before go_to.py subscribes.
        self._goal = rospy.Publisher("move_base_simple/goal", PoseStamped, queue_size=1, latch=True)
        self._done = rospy.Publisher("~done", Bool, queue_size=1, latch=True)
        rospy.Subscriber("go_to/arrived", Bool, self._on_arrival, queue_size=10)
        rospy.Subscriber("map", OccupancyGrid, self._on_map, queue_size=1)

    def _on_map(self, message: OccupancyGrid) -> None:
        try:
            found = self._transforms.lookup_transform(self._map_frame, self._base_frame, rospy.Time(0))
        except tf2_ros.TransformException as error:
            rospy.logwarn_throttle(10.0, f"waiting for a transform: {error}")
            return
        place = pose_of(found.transform)
        with self._lock:
            if message.header.stamp < self._mapped_at:  # time has restarted
                self._explorer = Explorer(self._explorer.footprint, self._explorer.shortest)
                self._without_goal = 0
            self._mapped_at = message.header.stamp
            if self._without_goal >= TIMEOUT:
                return
            changed = message.data and self._explorer.update(GridMap.from_message(message), (place.x, place.y))
            goal = self._explorer.goal
            if goal is not None:
                self._without_goal = 0
                if changed:
                    self._send(goal)
                return
            self._without_goal += 1
            if self._without_goal == TIMEOUT:
                rospy.loginfo("exploration complete: no reachable unknown area left")
                self._done.publish(True)

    def _on_arrival(self, arrived: Bool) -> None:
        with self._lock:
            self._explorer.discard_goal()

    def _send(self, point: Point) -> None:
        goal = PoseStamped()
        goal.header.frame_id = self._map_frame
        goal.header.stamp = rospy.Time.now()
        goal.pose.position.x, goal.pose.position.y = point  # without an orientation: any heading
        self._goal.publish(goal)


def main() -> int:
    """Run the node until shutdown; return 2 for invalid parameters."""
    return run_node("explore", __doc__, Explore)


if __name__ == "__main__":
    sys.exit(run_ros_program(main))
