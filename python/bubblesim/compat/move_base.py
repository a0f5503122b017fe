# SPDX-License-Identifier: BSD-3-Clause
"""The node move_base: the action move_base and the topic move_base_simple/goal.

It drives by the navigation of go_to.py on the topic map, or on a map of what its scans have seen, where global_costmap
has no static layer. Parameters of move_base, its costmaps and its planners that mean the same are read; the others have
no effect, and are named once. It publishes cmd_vel, ~current_goal, the plan as ~NavfnROS/plan and
~DWAPlannerROS/global_plan (or the names of the planners that are set), and both costmaps; services: ~make_plan,
~clear_costmaps.
"""

from __future__ import annotations

import threading
from typing import Any

import actionlib
import rospy
import tf2_ros
from geometry_msgs.msg import PoseStamped
from move_base_msgs.msg import MoveBaseAction, MoveBaseActionGoal, MoveBaseFeedback, MoveBaseResult
from nav_msgs.msg import OccupancyGrid
from nav_msgs.msg import Path as PathMessage
from sensor_msgs.msg import LaserScan
from std_srvs.srv import Empty, EmptyResponse

from bubblesim.compat.base_driver import BaseDriver
from bubblesim.compat.move_base_maps import MoveBaseMaps
from bubblesim.compat.move_base_settings import MoveBaseParameters, read_settings
from bubblesim.controllers.base_velocity import BaseVelocity
from bubblesim.controllers.planar_motion import Pose2D, Velocity
from bubblesim.navigation.driver import STANDING
from bubblesim.navigation.driving import GaveUpError
from bubblesim.navigation.grid_map import GridMap
from bubblesim.navigation.planar import Point, heading_of, hits, placed, pose_of
from bubblesim.nodes.path_message import path_message
from bubblesim.nodes.run_node import run_node
from bubblesim.nodes.twist_commands import TwistCommands


class MoveBase:
    """Has one goal at a time; a new one replaces it."""

    def __init__(self) -> None:
        """Connect the topics and start the server."""
        given = rospy.get_param("~", {})
        parameters = MoveBaseParameters(given)
        self._settings = settings = read_settings(parameters)
        self._lock = threading.Lock()  # callbacks and the server run in separate threads
        self._driver = BaseDriver(settings, rospy.logwarn)
        self._scans: dict[str, LaserScan] = {}  # the newest, by topic
        self._map_cells: Any = None  # origin and cells of the newest map
        self._shown: list[Point] = []  # the plan that was published last
        self._transforms = tf2_ros.Buffer()
        self._listener = tf2_ros.TransformListener(self._transforms)
        self._commands = TwistCommands()
        self._goal = rospy.Publisher("~current_goal", PoseStamped, queue_size=1)
        names = f"~{settings.global_planner}/plan", f"~{settings.local_planner}/global_plan"
        self._plans = [rospy.Publisher(name, PathMessage, queue_size=1) for name in names]
        self._maps = MoveBaseMaps(settings, parameters, self._pose_in, self._grid, self._hits)
        for topic in settings.scan_topics:
            rospy.Subscriber(topic, LaserScan, self._on_scan, topic, queue_size=1)
        if settings.obstacle_layer is None:
            rospy.Subscriber(settings.map_topic, OccupancyGrid, self._on_map, queue_size=1)
        rospy.Service("~clear_costmaps", Empty, self._clear)
        if unused := parameters.without_effect():
            rospy.loginfo(f"parameters without effect: {', '.join(unused)}")
        self._goals = rospy.Publisher("move_base/goal", MoveBaseActionGoal, queue_size=1)
        self._server = actionlib.SimpleActionServer("move_base", MoveBaseAction, self._execute, auto_start=False)
        self._server.start()
        rospy.Subscriber("move_base_simple/goal", PoseStamped, self._on_simple_goal, queue_size=1)

    def _on_scan(self, scan: Any, topic: str) -> None:
        self._scans[topic] = scan

    def _on_map(self, message: Any) -> None:
        if not message.data or (message.info.origin, message.data) == self._map_cells:
            return
        self._map_cells = message.info.origin, message.data
        with self._lock:
            self._driver.driving.grid = GridMap.from_message(message)
        self._maps.publish_global()

    def _on_simple_goal(self, message: Any) -> None:
        goal = MoveBaseActionGoal()
        goal.header.stamp = rospy.Time.now()
        goal.goal.target_pose = message
        self._goals.publish(goal)

    def _clear(self, _: Any) -> Any:
        """Forget what scans have seen; a map is used as it comes."""
        with self._lock:
            if self._driver.obstacles is not None:
                self._driver.obstacles.clear()
        return EmptyResponse()

    def _grid(self) -> GridMap | None:
        with self._lock:
            return self._driver.driving.grid if self._driver.obstacles is None else self._driver.obstacles.grid

    def _hits(self) -> list[Point]:
        """Return the points of the newest scans, in the robot's frame."""
        found: list[Point] = []
        for scan in list(self._scans.values()):
            lidar = self._pose_in(scan.header.frame_id.lstrip("/"), self._settings.base_frame)
            found += hits(scan, lidar) if lidar is not None else []
        return found

    def _execute(self, goal: Any) -> None:
        if not self._start(goal.target_pose):
            self._server.set_aborted(MoveBaseResult(), "There is no transform from the goal's frame.")
            return
        rate = rospy.Rate(self._settings.control_frequency, reset=True)
        while not rospy.is_shutdown():
            if self._server.is_preempt_requested():
                if not self._server.is_new_goal_available():
                    self._stop()
                self._server.set_preempted()
                return
            try:
                arrived = self._drive()
            except GaveUpError as error:
                self._stop()
                rospy.logwarn(f"goal aborted: {error}")
                self._server.set_aborted(MoveBaseResult(), f"Failed to find a valid plan or to follow it: {error}.")
                return
            if arrived:
                self._stop()
                self._server.set_succeeded(MoveBaseResult(), "Goal reached.")
                return
            rate.sleep()

    def _start(self, target: Any) -> bool:
        frame = self._pose_in(target.header.frame_id.lstrip("/"), self._settings.map_frame)
        if frame is None:
            rospy.logwarn(f"no transform from {target.header.frame_id} to {self._settings.map_frame}")
            return False
        place, turn = target.pose.position, target.pose.orientation
        no_heading = turn.x == turn.y == turn.z == turn.w == 0.0
        heading = None if no_heading else heading_of(turn) + frame.heading
        with self._lock:
            self._driver.start(placed(frame, (place.x, place.y)), heading, rospy.get_time())
        self._goal.publish(target)
        return True

    def _drive(self) -> bool:
        """Send the next command, and the pose as feedback; return whether the goal is reached."""
        found = self._transform_of_base()
        if found is None:
            return False
        pose, now, points = pose_of(found.transform), rospy.get_time(), self._hits()
        with self._lock:
            self._driver.see(pose, points, now)
            command = self._driver.update(pose, now)
            path = self._driver.driving.path
        self._show(path)
        self._server.publish_feedback(MoveBaseFeedback(base_position=_place(found)))
        if command is None:
            return True
        self._send(command)
        return False

    def _stop(self) -> None:
        with self._lock:
            self._driver.stop()
        self._send(STANDING)
        self._show([])

    def _send(self, command: Velocity) -> None:
        self._commands.publish(BaseVelocity(forward=command.linear, turning=command.angular))

    def _show(self, points: list[Point]) -> None:
        if points is self._shown:
            return
        self._shown = points
        if any(publisher.get_num_connections() for publisher in self._plans):
            message = path_message(self._settings.map_frame, points)
            for publisher in self._plans:
                publisher.publish(message)

    def _pose_in(self, frame: str, parent: str) -> Pose2D | None:
        try:
            return pose_of(self._transforms.lookup_transform(parent, frame, rospy.Time(0)).transform)
        except tf2_ros.TransformException as error:
            rospy.logwarn_throttle(10.0, f"waiting for a transform: {error}")
            return None

    def _transform_of_base(self) -> Any:
        frames = self._settings.map_frame, self._settings.base_frame
        try:
            return self._transforms.lookup_transform(*frames, rospy.Time(0))
        except tf2_ros.TransformException as error:
            rospy.logwarn_throttle(10.0, f"waiting for a transform: {error}")
            return None


def _place(transform: Any) -> Any:
    place = PoseStamped(header=transform.header)
    translation = transform.transform.translation
    place.pose.position.x, place.pose.position.y = translation.x, translation.y
    place.pose.orientation = transform.transform.rotation
    return place


def main() -> int:
    """Run the node until shutdown; return 2 for invalid parameters."""
    return run_node("move_base", __doc__, MoveBase)
