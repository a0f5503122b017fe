# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_diff_drive: two driven wheels, commanded by a Twist."""

from __future__ import annotations

from bubblesim.controllers.differential_drive import DifferentialDrive
from bubblesim.devices.device import FASTEST, Device, Place
from bubblesim.devices.odometry import SOURCES, Odometry, covariance
from bubblesim.devices.rate import Rate
from bubblesim.devices.two_sided_drive import TwoSidedDrive
from bubblesim.devices.wheels import WheelTopics


class DiffDrive(Device):
    """Parameters, topics and defaults are those of gazebo_ros_pkgs in ROS Kinetic to Noetic.

    Joints that are named as in ROS 2, <left_joint>, make it the plugin of ROS 2, which has no legacyMode.
    """

    def __init__(self, place: Place) -> None:
        """Read the parameters."""
        super().__init__(place)
        p = self.parameters
        self.enter_namespace(of_model=True)
        left, right = self.joint("leftJoint", "left_joint"), self.joint("rightJoint", "right_joint")
        is_of_ros2 = any(parameter.name in ("left_joint", "ros") for parameter in p.plugin.parameters)
        # In its first years the plugin took one wheel for the other, and in ROS 1 it still does unless told not to.
        if p.flag("legacyMode", default=not is_of_ros2):
            p.hint_if_missing(
                "legacyMode",
                "is missing and thus true, as in Gazebo: it turns to the right for a positive angular.z; with false, "
                "to the left",
            )
            left, right = right, left
        self._by_wheels = p.choice("odometrySource", "world", SOURCES) == "encoder"
        self._rate = Rate(p.number("updateRate", 100.0, least=0.0), self.simulation.time_step)
        geometry = DifferentialDrive(p.length("wheelDiameter", 0.15) / 2, p.length("wheelSeparation", 0.34), FASTEST)
        torque = p.number("wheelTorque", p.number("max_wheel_torque", 5.0, least=0.0), least=0.0)
        acceleration = p.number("wheelAcceleration", p.number("max_wheel_acceleration", 0.0, least=0.0), least=0.0)
        tells_odometry = p.flag("publish_odom", default=False) if is_of_ros2 else p.flag("publishTf", default=True)
        p.check()
        self._drive = TwoSidedDrive(self, geometry, [left], [right], torque=torque, acceleration=acceleration)
        self._odometry = Odometry(
            self,
            topic=p.text("odometryTopic", "odom"),
            frame=self.frame(p.text("odometryFrame", "odom")),
            base_frame=self.frame(p.text("robotBaseFrame", "base_footprint")),
            transform=p.flag("publishOdomTF", default=not is_of_ros2),
            pose_covariance=covariance(1e-5, 1e-5, 1e-3),
        )
        self._tells_odometry = tells_odometry
        self._wheels = WheelTopics(self, (right, left))
        self._drive.hear(p.text("commandTopic", "cmd_vel"))

    def reset(self) -> None:
        """Stand still."""
        self._drive.reset()
        self._rate.reset()

    def actuate(self) -> None:
        """Command the wheels."""
        self._drive.actuate()

    def publish(self) -> None:
        """Tell the odometry and, on demand, of the wheels."""
        motion = self._drive.moved(by_wheels=self._by_wheels)
        if not self._rate.due(self.simulation.time):
            return
        if self._tells_odometry:
            self._odometry.publish(motion)
        self._wheels.publish()
