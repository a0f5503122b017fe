# SPDX-License-Identifier: BSD-3-Clause
"""The packages that have the names of packages which Debian lacks; a package of the user with that name comes first."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import rospkg

# What each provides.
PACKAGES = {
    "ackermann_msgs": "messages",
    "control_msgs": "messages, services and actions of controllers",
    "controller_manager": "spawner, unspawner, controller_manager",
    "controller_manager_msgs": "services of the controller manager",
    "four_wheel_steering_msgs": "messages",
    "gazebo_msgs": "messages and services of gazebo_ros",
    "gazebo_plugins": "the name; the plugins are built in",
    "gazebo_ros": "empty_world.launch, shapes_world.launch, gzserver, gazebo, gzclient, spawn_model",
    "gazebo_ros_control": "the name; the plugin is built in",
    "joy": "joy_node",
    "kobuki_msgs": "messages",
    "map_server": "map_server",
    "mav_msgs": "messages",
    "mouse_teleop": "mouse_teleop.py",
    "move_base": "move_base, over go_to.py",
    "pointcloud_to_laserscan": "pointcloud_to_laserscan_node",
    "robot_localization": "ekf_localization_node, which integrates the odometry and is no Kalman filter",
    "teleop_twist_joy": "teleop_node",
    "teleop_twist_keyboard": "teleop_twist_keyboard.py",
    "twist_mux": "twist_mux",
    "xacro": "xacro of PyPI",
}
_OURS = "The bubblesim developers"


def folder_of(package: str) -> Path | None:
    """Return the folder in which ROS finds a package, None if it does not."""
    try:
        return Path(rospkg.RosPack().get_path(package))
    except rospkg.ResourceNotFound:
        return None


def is_ours(folder: Path) -> bool:
    """Return whether a package is one of bubblesim's."""
    return (ElementTree.parse(folder / "package.xml").getroot().findtext("maintainer") or "").strip() == _OURS
