# SPDX-License-Identifier: BSD-3-Clause
"""The program spawn_model: adds a model to the simulation through the services of the node gazebo."""

from __future__ import annotations

import argparse
import math
import os
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import rospy

TIMEOUT = 60.0  # s to wait for the simulator and for the parameter


def main(arguments: Sequence[str]) -> int:
    """Add the model; return 1 if it could not be added, 2 for bad arguments."""
    options = parser().parse_args(arguments)
    rospy.init_node("spawn_model", anonymous=True)
    try:
        xml = _model_xml(options)
        _wait_for_model(options)
        _spawn(options, xml)
        for joint, position in options.J:
            _set_joint(options, joint, float(position))
        if options.unpause:
            _call(options, "unpause_physics", "std_srvs/Empty")
    except (OSError, ValueError, LookupError, rospy.ROSException, rospy.ServiceException) as error:
        if rospy.is_shutdown():
            return 0
        rospy.logerr(f"model {options.model} was not spawned: {error}")
        return 1
    if options.b:
        rospy.loginfo(f"model {options.model} is removed when this program ends")
        rospy.on_shutdown(lambda: _call(options, "delete_model", "gazebo_msgs/DeleteModel", model_name=options.model))
        rospy.spin()
    return 0


def parser() -> argparse.ArgumentParser:
    """Return the parser of the arguments, which are those of gazebo_ros."""
    description = "Adds a model to the simulation."
    result = argparse.ArgumentParser(prog="spawn_model", description=description, allow_abbrev=False)
    formats = result.add_mutually_exclusive_group()
    formats.add_argument("-urdf", action="store_true", help="the model is in URDF (both formats are recognized)")
    formats.add_argument("-sdf", action="store_true", help="the model is in SDFormat")
    source = result.add_mutually_exclusive_group(required=True)
    source.add_argument("-param", metavar="NAME", help="a parameter has the model")
    source.add_argument("-file", metavar="FILE", help="a file has the model")
    source.add_argument("-database", metavar="MODEL", help="model://MODEL")
    source.add_argument("-stdin", action="store_true", help="the model comes on stdin")
    result.add_argument("-model", metavar="NAME", required=True, help="name of the model in the simulation")
    for name in "xyz":
        result.add_argument(f"-{name}", type=_number, default=0.0, help="initial position in m")
    for name in "RPY":
        result.add_argument(f"-{name}", type=_number, default=0.0, help="initial roll, pitch and yaw in rad")
    result.add_argument("-J", nargs=2, action="append", default=[], metavar=("JOINT", "POSITION"), help="rad or m")
    result.add_argument("-reference_frame", default="", help="model or link that the pose is relative to")
    result.add_argument("-robot_namespace", help="namespace of the model's plugins (default: that of this program)")
    result.add_argument("-gazebo_namespace", default="/gazebo", help="namespace of the simulator's services")
    result.add_argument("-wait", metavar="MODEL", help="wait until the simulation has this model")
    result.add_argument("-unpause", action="store_true", help="start the simulation afterwards")
    result.add_argument("-package_to_model", action="store_true", help="accepted: package:// is found as it is")
    result.add_argument("-trimesh", help="accepted without an effect")
    result.add_argument("-b", action="store_true", help="run until SIGINT, and remove the model then")
    return result


def orientation(roll: float, pitch: float, yaw: float) -> tuple[float, float, float, float]:
    """Return the quaternion (x, y, z, w) of rotations about the fixed axes x, y and z, rad, in this order."""
    (sr, cr), (sp, cp), (sy, cy) = ((math.sin(angle / 2), math.cos(angle / 2)) for angle in (roll, pitch, yaw))
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )


def _number(text: str) -> float:
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(text)
    return value


def _model_xml(options: argparse.Namespace) -> str:
    if options.stdin:
        return sys.stdin.read()
    if options.database:
        return (
            f"<sdf version='1.6'><model name='{options.model}'><include merge='true'>"
            f"<uri>model://{options.database}</uri></include></model></sdf>"
        )
    if options.file:
        return Path(os.path.expandvars(options.file)).expanduser().read_text(encoding="utf-8")
    until = rospy.get_rostime().to_sec() + TIMEOUT
    while not rospy.has_param(options.param):
        if rospy.is_shutdown() or rospy.get_rostime().to_sec() > until:
            raise LookupError(f"there is no parameter {rospy.resolve_name(options.param)}")
        rospy.rostime.wallsleep(0.1)
    return str(rospy.get_param(options.param))


def _wait_for_model(options: argparse.Namespace) -> None:
    if not options.wait:
        return
    while not rospy.is_shutdown():
        if options.wait in _call(options, "get_world_properties", "gazebo_msgs/GetWorldProperties").model_names:
            return
        rospy.rostime.wallsleep(0.2)


def _spawn(options: argparse.Namespace, xml: str) -> None:
    from geometry_msgs.msg import Point, Pose, Quaternion

    service = "spawn_sdf_model" if options.sdf or options.database else "spawn_urdf_model"
    pose = Pose(Point(options.x, options.y, options.z), Quaternion(*orientation(options.R, options.P, options.Y)))
    namespace = rospy.get_namespace() if options.robot_namespace is None else options.robot_namespace
    answer = _call(
        options,
        service,
        "gazebo_msgs/SpawnModel",
        model_name=options.model,
        model_xml=xml,
        robot_namespace=namespace,
        initial_pose=pose,
        reference_frame=options.reference_frame,
    )
    rospy.loginfo(answer.status_message)


def _set_joint(options: argparse.Namespace, joint: str, position: float) -> None:
    _call(
        options,
        "set_model_configuration",
        "gazebo_msgs/SetModelConfiguration",
        model_name=options.model,
        joint_names=[joint],
        joint_positions=[position],
    )


def _call(options: argparse.Namespace, name: str, kind: str, **request: Any) -> Any:
    """Call a service of the simulator; raise ValueError with its message if it does not succeed."""
    import roslib.message

    service = f"{options.gazebo_namespace.rstrip('/')}/{name}"
    rospy.wait_for_service(service, TIMEOUT)
    answer = rospy.ServiceProxy(service, roslib.message.get_service_class(kind))(**request)
    if not getattr(answer, "success", True):
        raise ValueError(answer.status_message)
    return answer
