#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Drive to the goals of move_base_simple/goal on a map, and stop in front of obstacles.

Subscribes to map, scan and move_base_simple/goal; publishes cmd_vel, ~path, ~arrived (Bool) at the end of each goal.
Parameters: ~map_frame, ~base_frame, ~radius (m, of the robot), ~length and ~width (m, of a rectangular robot, otherwise
0), ~comfort (m, preferred distance to walls), ~max_speed (m/s), ~max_turn (rad/s), ~acceleration (m/s2),
~lookahead (m), ~turning_radius (m, 0 for a robot that turns in place), ~tolerance (m), ~yaw_tolerance (rad),
~patience (s in front of an obstacle after which the goal is aborted).
"""

import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C while modules are loaded shows no traceback

from bubblesim.program import users_packages

users_packages.leave_out()

import dataclasses
import sys
import threading

import rospy
import tf2_ros
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import OccupancyGrid, Path
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Bool

from bubblesim.controllers.base_velocity import BaseVelocity
from bubblesim.controllers.planar_motion import Pose2D, Velocity
from bubblesim.navigation.driver import STANDING, Driver
from bubblesim.navigation.driving import Driving, GaveUpError
from bubblesim.navigation.grid_map import GridMap
from bubblesim.navigation.local_planning import Body
from bubblesim.navigation.path_planning import Footprint
from bubblesim.navigation.planar import Point, heading_of, hits, placed, pose_of
from bubblesim.nodes.path_message import path_message
from bubblesim.nodes.run_node import run_node, run_ros_program
from bubblesim.nodes.twist_commands import TwistCommands

RATE = 10.0  # Hz, of commands
SPARE = 0.05  # m, margin of paths in addition to the robot's radius, for the path following error


class GoTo:
    """Stores the latest map and scan, and drives while there is a goal."""

    def __init__(self, driver: Driver, footprint: Footprint, body: Body | None) -> None:
        """Create publishers and subscribers; the node must be initialised."""
        self._driving = Driving(driver, footprint, float(rospy.get_param("~patience", 10.0)), body=body)
        self._map_frame = str(rospy.get_param("~map_frame", "map"))
        self._base_frame = str(rospy.get_param("~base_frame", "base_link"))
        self._shown: list[Point] = []  # the path that was published last
        self._lock = threading.Lock()  # callbacks and the timer run in separate threads
        self._transforms = tf2_ros.Buffer()
        self._listener = tf2_ros.TransformListener(self._transforms)
        self._commands = TwistCommands()
        self._path = rospy.Publisher("~path", Path, queue_size=1, latch=True)
        self._arrived = rospy.Publisher("~arrived", Bool, queue_size=10)
        rospy.Subscriber("map", OccupancyGrid, self._on_map, queue_size=1)
        rospy.Subscriber("scan", LaserScan, self._on_scan, queue_size=1)
        rospy.Subscriber("move_base_simple/goal", PoseStamped, self._on_goal, queue_size=1)
        rospy.Timer(rospy.Duration.from_sec(1.0 / RATE), lambda event: self._on_time(), reset=True)

    def _on_map(self, message: OccupancyGrid) -> None:
        if message.data:
            with self._lock:
                self._driving.grid = GridMap.from_message(message)

    def _on_scan(self, scan: LaserScan) -> None:
        lidar = self._place_of(scan.header.frame_id, self._base_frame)
        if lidar is not None:
            with self._lock:
                self._driving.obstacles = hits(scan, lidar)

    def _on_goal(self, goal: PoseStamped) -> None:
        frame = self._place_of(goal.header.frame_id, self._map_frame)
        if frame is None:
            rospy.logwarn(f"goal ignored: no transform from its frame {goal.header.frame_id} to {self._map_frame}")
            return
        place, turn = goal.pose.position, goal.pose.orientation
        no_heading = turn.x == turn.y == turn.z == turn.w == 0.0
        heading = None if no_heading else heading_of(turn) + frame.heading
        with self._lock:
            self._driving.start(placed(frame, (place.x, place.y)), rospy.get_time(), heading)

    def _on_time(self) -> None:
        place = self._place_of(self._base_frame, self._map_frame)
        with self._lock:
            if self._driving.goal is None or place is None or rospy.is_shutdown():
                return
            try:
                command = self._driving.update(Pose2D(place.x, place.y, place.heading), rospy.get_time())
            except GaveUpError as error:
                rospy.logwarn(f"goal aborted: {error}")
                self._end(arrived=False)
                return
            if command is None:
                self._end(arrived=True)
                return
            self._send(command)
            self._show(self._driving.path)

    def _end(self, *, arrived: bool) -> None:
        self._send(STANDING)
        self._show([])
        self._arrived.publish(arrived)

    def _send(self, command: Velocity) -> None:
        self._commands.publish(BaseVelocity(forward=command.linear, turning=command.angular))

    def _show(self, points: list[Point]) -> None:
        if points is self._shown:
            return
        self._shown = points
        self._path.publish(path_message(self._map_frame, points))

    def _place_of(self, frame: str, parent: str) -> Pose2D | None:
        """Return the pose of a frame in its parent, None without a transform."""
        try:
            return pose_of(self._transforms.lookup_transform(parent, frame, rospy.Time(0)).transform)
        except tf2_ros.TransformException as error:
            rospy.logwarn_throttle(10.0, f"waiting for a transform: {error}")
            return None


def read_driver() -> Driver:
    """Read the driving parameters of the node."""
    defaults = dataclasses.asdict(Driver())
    driver = Driver(**{name: float(rospy.get_param(f"~{name}", value)) for name, value in defaults.items()})
    for name, value in dataclasses.asdict(driver).items():
        if not value >= 0.0 or (value == 0.0 and name != "turning_radius"):
            raise ValueError(f"{name} is {value}, must be above 0")
    return driver


def make() -> GoTo:
    """Create the node from its parameters."""
    driver = read_driver()
    comfort = float(rospy.get_param("~comfort", driver.radius + 0.3))
    length, width = (float(rospy.get_param(f"~{name}", 0.0)) for name in ("length", "width"))
    if not (length >= 0.0 and width >= 0.0 and (length > 0.0) == (width > 0.0)):
        raise ValueError(f"length is {length} and width is {width}, both must be above 0, or 0 for a round robot")
    body = Body.rectangle(length, width) if length > 0.0 else None
    return GoTo(driver, Footprint(driver.radius + SPARE, comfort), body)


def main() -> int:
    """Run the node until shutdown; return 2 for invalid parameters."""
    return run_node("go_to", __doc__, make)


if __name__ == "__main__":
    sys.exit(run_ros_program(main))
