# SPDX-License-Identifier: BSD-3-Clause
"""The node move_base: the action move_base and the topic move_base_simple/goal, driven to by go_to.py.

The service ~make_plan plans on the topic map, ~global_costmap/costmap and ~local_costmap/costmap show it and the scan.
It starts go_to.py as a node of its own, which plans on the topic map and avoids what is on the topic scan. Parameters
of move_base that mean the same are passed on: the frames and robot_radius of global_costmap and local_costmap, and
speeds, acceleration and goal tolerance of DWAPlannerROS and TebLocalPlannerROS. The others have no effect.
"""

from __future__ import annotations

import subprocess
from collections.abc import Mapping
from typing import Any

import actionlib
import rospy
import tf2_ros
from geometry_msgs.msg import PoseStamped
from move_base_msgs.msg import MoveBaseAction, MoveBaseActionGoal, MoveBaseFeedback, MoveBaseResult
from std_msgs.msg import Bool
from std_srvs.srv import Empty, EmptyResponse

from bubblesim.compat.move_base_maps import MoveBaseMaps
from bubblesim.controllers.planar_motion import Pose2D
from bubblesim.navigation.driver import Driver
from bubblesim.navigation.path_planning import Footprint
from bubblesim.navigation.planar import pose_of
from bubblesim.nodes.run_node import run_node
from bubblesim.running.places import node_program

_RATE = 10.0  # Hz, of feedback
_SPARE, _COMFORT = 0.05, 0.3  # m beside the robot's radius, as in go_to.py

# The parameter of go_to.py, and where move_base has it; the first that is given counts.
_SAME = {
    "map_frame": ("global_costmap/global_frame",),
    "base_frame": ("global_costmap/robot_base_frame", "local_costmap/robot_base_frame"),
    "radius": ("global_costmap/robot_radius", "local_costmap/robot_radius"),
    "max_speed": ("DWAPlannerROS/max_vel_x", "DWAPlannerROS/max_vel_trans", "TebLocalPlannerROS/max_vel_x"),
    "max_turn": ("DWAPlannerROS/max_vel_theta", "DWAPlannerROS/max_rot_vel", "TebLocalPlannerROS/max_vel_theta"),
    "acceleration": ("DWAPlannerROS/acc_lim_x", "TebLocalPlannerROS/acc_lim_x"),
    "tolerance": ("DWAPlannerROS/xy_goal_tolerance", "TebLocalPlannerROS/xy_goal_tolerance"),
}


def driver_parameters(given: Mapping[str, Any]) -> dict[str, Any]:
    """Return the parameters of go_to.py for those of move_base, a dictionary of dictionaries."""

    def find(path: str) -> Any:
        value: Any = given
        for key in path.split("/"):
            value = value.get(key) if isinstance(value, Mapping) else None
        return value

    found = {
        name: next((find(path) for path in paths if find(path) is not None), None) for name, paths in _SAME.items()
    }
    return {name: value for name, value in found.items() if value is not None}


class MoveBase:
    """Has one goal at a time; a new one replaces it."""

    def __init__(self) -> None:
        """Start the driver and the server."""
        given = rospy.get_param("~", {})
        parameters = driver_parameters(given)
        self._map_frame = str(parameters.get("map_frame", "map"))
        self._base_frame = str(parameters.get("base_frame", "base_link"))
        self._arrived: bool | None = None
        self._transforms = tf2_ros.Buffer()
        self._listener = tf2_ros.TransformListener(self._transforms)
        driver = f"{rospy.get_name()}_driver"
        self._driver_goal = rospy.Publisher("~current_goal", PoseStamped, queue_size=1)
        rospy.Subscriber(f"{driver}/arrived", Bool, self._on_arrived, queue_size=10)
        self._goals = rospy.Publisher("move_base/goal", MoveBaseActionGoal, queue_size=1)
        rospy.Subscriber("move_base_simple/goal", PoseStamped, self._on_simple_goal, queue_size=1)
        rospy.Service("~clear_costmaps", Empty, lambda _: EmptyResponse())  # maps are used as they come
        radius = float(parameters.get("radius", Driver().radius))
        footprint = Footprint(radius + _SPARE, radius + _COMFORT)
        self._maps = MoveBaseMaps((self._map_frame, self._base_frame), footprint, given, self._pose_in)
        self._process = _start_driver(driver, parameters)
        rospy.on_shutdown(self._process.terminate)
        while self._driver_goal.get_num_connections() == 0 and self._process.poll() is None and not rospy.is_shutdown():
            rospy.rostime.wallsleep(0.05)  # a goal that comes before the driver would be lost
        self._server = actionlib.SimpleActionServer("move_base", MoveBaseAction, self._execute, auto_start=False)
        self._server.start()

    def _on_arrived(self, message: Any) -> None:
        self._arrived = bool(message.data)

    def _on_simple_goal(self, message: Any) -> None:
        goal = MoveBaseActionGoal()
        goal.header.stamp = rospy.Time.now()
        goal.goal.target_pose = message
        self._goals.publish(goal)

    def _execute(self, goal: Any) -> None:
        self._arrived = None
        self._driver_goal.publish(goal.target_pose)
        while not rospy.is_shutdown() and self._process.poll() is None:
            if self._server.is_preempt_requested():
                if not self._server.is_new_goal_available():
                    self._stop()
                self._server.set_preempted()
                return
            if self._arrived is not None:
                if self._arrived:
                    self._server.set_succeeded(MoveBaseResult(), "Goal reached.")
                else:
                    self._server.set_aborted(MoveBaseResult(), "Failed to find a valid plan or to follow it.")
                return
            place = self._place()
            if place is not None:
                self._server.publish_feedback(MoveBaseFeedback(base_position=place))
            rospy.rostime.wallsleep(1.0 / _RATE)
        self._server.set_aborted(MoveBaseResult(), "The driver has ended.")

    def _stop(self) -> None:
        """Make the place of the robot the goal, without a heading: the driver is there at once."""
        place = self._place()
        if place is not None:
            orientation = place.pose.orientation
            orientation.x = orientation.y = orientation.z = orientation.w = 0.0
            self._driver_goal.publish(place)

    def _pose_in(self, frame: str, parent: str) -> Pose2D | None:
        try:
            return pose_of(self._transforms.lookup_transform(parent, frame, rospy.Time(0)).transform)
        except tf2_ros.TransformException:
            return None

    def _place(self) -> Any:
        try:
            transform = self._transforms.lookup_transform(self._map_frame, self._base_frame, rospy.Time(0))
        except tf2_ros.TransformException:
            return None
        place = PoseStamped(header=transform.header)
        translation = transform.transform.translation
        place.pose.position.x, place.pose.position.y = translation.x, translation.y
        place.pose.orientation = transform.transform.rotation
        return place


def _start_driver(name: str, parameters: Mapping[str, Any]) -> subprocess.Popen[bytes]:
    program = node_program().with_name("go_to.py")
    arguments = [f"_{key}:={value}" for key, value in parameters.items()]
    goal = f"move_base_simple/goal:={rospy.resolve_name('~current_goal')}"
    own = [f"{topic}:={rospy.resolve_name(topic)}" for topic in ("map", "scan", "cmd_vel")]
    return subprocess.Popen([str(program), *arguments, goal, *own, f"__name:={name.rpartition('/')[2]}"])


def main() -> int:
    """Run the node until shutdown; return 2 for invalid parameters."""
    return run_node("move_base", __doc__, MoveBase)
