# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_diff_drive: pairs of driven wheels, commanded by a Twist."""

from __future__ import annotations

from bubblesim.controllers.differential_drive import DifferentialDrive
from bubblesim.gazebo_plugins.drives.odometry import SOURCES, Odometry, variances
from bubblesim.gazebo_plugins.drives.two_sided_drive import TwoSidedDrive, WheelGroup
from bubblesim.gazebo_plugins.drives.wheels import WheelTopics
from bubblesim.gazebo_plugins.plugin import FASTEST, Plugin, PluginContext
from bubblesim.gazebo_plugins.rate import Rate


class DiffDrive(Plugin):
    """Parameters, topics and defaults are those of gazebo_ros_pkgs in ROS Kinetic to Noetic.

    Joint names as in ROS 2, <left_joint>, select the plugin of ROS 2, which has no legacyMode and supports several
    pairs of wheels: <num_wheel_pairs> of them, each joint, separation and diameter in a separate element.
    """

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace(of_model=True)
        left, right = (self._joints(f"{side}Joint", f"{side}_joint") for side in ("left", "right"))
        pairs = self._count_pairs(left, right)
        is_of_ros2 = any(parameter.name in ("left_joint", "ros") for parameter in p.plugin.parameters)
        # The first versions of the plugin swapped the wheels. In ROS 1 it still does, unless legacyMode is false.
        if p.flag("legacyMode", default=not is_of_ros2):
            p.hint_if_missing(
                "legacyMode",
                "is missing and defaults to true, as in Gazebo: a positive angular.z turns right; with false, left",
            )
            left, right = right, left
        self._by_wheels = p.choice("odometrySource", "world", SOURCES) == "encoder"
        rate = p.number("updateRate", 100.0, least=0.0)
        self._rate = Rate(rate, self.simulation)
        diameters, separations = p.lengths("wheelDiameter", 0.15, pairs), p.lengths("wheelSeparation", 0.34, pairs)
        torque = p.number("wheelTorque", p.number("max_wheel_torque", 5.0, least=0.0), least=0.0)
        acceleration = p.number("wheelAcceleration", p.number("max_wheel_acceleration", 0.0, least=0.0), least=0.0)
        publishes_odometry = p.flag("publish_odom", default=False) if is_of_ros2 else p.flag("publishTf", default=True)
        p.check()
        groups = [
            WheelGroup(DifferentialDrive(diameter / 2, separation, FASTEST), [left_one], [right_one])
            for diameter, separation, left_one, right_one in zip(diameters, separations, left, right, strict=True)
        ]
        self._drive = TwoSidedDrive(self, *groups, torque=torque, acceleration=acceleration, rate=rate)
        self._odometry = Odometry(
            self,
            topic=p.text("odometryTopic", "odom"),
            frame=self.frame(p.text("odometryFrame", "odom")),
            base_frame=self.frame(p.text("robotBaseFrame", "base_footprint")),
            transform=p.flag("publishOdomTF", default=not is_of_ros2),
            pose_variances=variances(1e-5, 1e-5, 1e-3),
        )
        self._publishes_odometry = publishes_odometry
        self._wheels = WheelTopics(self, [joint for pair in zip(right, left, strict=True) for joint in pair])
        self._drive.subscribe(p.text("commandTopic", "cmd_vel"))

    def _joints(self, parameter: str, default: str) -> list[int]:
        return [self.joint_named(name, parameter) for name in self.parameters.names(parameter) or [default]]

    def _count_pairs(self, left: list[int], right: list[int]) -> int:
        p = self.parameters
        pairs = p.number("num_wheel_pairs", len(left), least=1.0)
        for side, joints in (("left", left), ("right", right)):
            if len(joints) != pairs:
                raise p.fail(
                    f"{side}Joint", f"is given {len(joints)} times, expected {pairs:g}: once per pair of wheels"
                )
        return len(left)

    def reset(self) -> None:
        """Stop."""
        self._drive.reset()
        self._rate.reset()

    def publish(self) -> None:
        """Publish the odometry and, if subscribed, the wheels' topics."""
        motion = self._drive.moved(by_wheels=self._by_wheels)
        if not self._rate.due():
            return
        if self._publishes_odometry:
            self._odometry.publish(motion)
        self._wheels.publish()
