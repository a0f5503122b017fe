# SPDX-License-Identifier: BSD-3-Clause
"""Controllers of mobile bases by wheels that are driven and steered: commands to wheels, odometry."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

from bubblesim._core.control import (
    AckermannSteeringController,
    AckermannWheels,
    BaseSettings,
    DiffDriveController,
    DiffDriveWheels,
    FourWheelSteeringController,
    FourWheelSteeringWheels,
    MecanumDriveController,
    MecanumWheels,
)
from bubblesim._core.reading_messages import odometry
from bubblesim.gazebo_plugins.control.controller import Controller, Robot
from bubblesim.gazebo_plugins.control.ros_parameters import ControllerError, ControllerParameters
from bubblesim.gazebo_plugins.drives.wheels import wheel_radius
from bubblesim.geometry.rotations import quaternion_of_heading

_Limit = tuple[float, float] | None
_NO_LIMITS: list[_Limit] = [None, None, None]


class BaseController(Controller):
    """What controllers of bases have in common."""

    def __init__(self, robot: Robot, name: str, parameters: ControllerParameters) -> None:
        """Read the parameters about topics and frames."""
        super().__init__(robot, name, parameters)
        p = parameters
        self._rate = self.rate("publish_rate", 50.0)
        self._base_frame = p.text("base_frame_id", "base_link")
        self._odom_frame = p.text("odom_frame_id", "odom")
        self._publishes_transform = p.flag("enable_odom_tf", default=True)
        self._variances = [p.numbers(f"{what}_covariance_diagonal", 6, [0.0] * 6) for what in ("pose", "twist")]
        self._publisher = self.advertise(self.topic("odom"), "nav_msgs/Odometry", 100)
        self._limited = None
        if p.flag("publish_cmd", default=False):
            self._limited = self.advertise(self.topic("cmd_vel_out"), "geometry_msgs/TwistStamped", 100)

    def settings(self, *, by_angles: bool = False) -> Any:
        """Return the settings of the core controller; angles that are commanded have no limits."""
        p = self.parameters
        others = (
            [_NO_LIMITS] * 2 if by_angles else [limits_of(p.below(*k)) for k in (("linear", "y"), ("angular", "z"))]
        )
        return BaseSettings(
            p.number("cmd_vel_timeout", 0.5),
            p.flag("open_loop", default=False),
            int(p.length("velocity_rolling_window_size", 10)),
            [limits_of(p.below("linear", "x")), *others],
        )

    def accept_commands(self, fields: Sequence[str] = ("linear.x", "angular.z")) -> None:
        """Subscribe to cmd_vel, when the core controller is there."""
        self.subscribe_numbers("cmd_vel", "geometry_msgs/Twist", fields, self.core.commands())

    def size(self, key: str, measured: Callable[[], float]) -> float:
        """Return a length that a parameter gives, or else the model."""
        return self.parameters.length(key) if self.parameters.has(key) else measured()

    def distance(self, joints: Sequence[str]) -> float:
        """Return the distance of two joints, m."""
        world = self.robot.plugin.world
        first, second = (world.pose(self.robot.joints[name].handle)[:3] for name in joints)
        return math.dist(first, second)

    def radius(self, joint: str) -> float:
        """Return the radius of the cylinder or sphere with which a wheel collides, m.

        :raises ControllerError: if it has none.
        """
        found = wheel_radius(self.robot.plugin, self.robot.joints[joint].handle)
        if found is None:
            raise ControllerError(
                f"parameter {self.parameters.name}/wheel_radius is missing, and the wheel of '{joint}' is neither "
                "a cylinder nor a sphere"
            )
        return float(found)

    def reset(self) -> None:
        """Reset the rate."""
        self._rate.reset()

    def publish(self) -> None:
        """Publish odometry, its transform and the limited command."""
        if not self._rate.due():
            return
        plugin = self.robot.plugin
        if self._limited is not None and self.is_needed(self._limited):
            ahead, left, turning = self.core.limited_command()
            twist = {"linear": {"x": ahead, "y": left}, "angular": {"z": turning}}
            self.send(self._limited, {"header": {"stamp": self.robot.stamp()}, "twist": twist})
        x, y, heading, forward, left, turning = self.core.odometry()
        pose = [x, y, 0.0, *quaternion_of_heading(heading)]
        header = plugin.header(self._odom_frame)
        if self._publishes_transform:
            plugin.context.transforms.add(header, self._base_frame, pose)
        if self.is_needed(self._publisher):
            velocity = (forward, left, 0.0), (0.0, 0.0, turning)
            self.send(self._publisher, odometry(header, self._base_frame, pose, *velocity, *self._variances))


class DiffDrive(BaseController):
    """diff_drive_controller/DiffDriveController."""

    def __init__(self, robot: Robot, name: str, parameters: ControllerParameters) -> None:
        """Read the parameters; dimensions that they do not give are those of the model."""
        super().__init__(robot, name, parameters)
        p = parameters
        left, right = p.names("left_wheel"), p.names("right_wheel")
        joints = self.claim("velocity", left), self.claim("velocity", right)
        separation = self.size("wheel_separation", lambda: self.distance([left[0], right[0]]))
        radius = self.size("wheel_radius", lambda: self.radius(left[0]))
        separation *= p.length("wheel_separation_multiplier", 1.0)
        both = p.length("wheel_radius_multiplier", 1.0)
        radii = [radius * p.length(f"{side}_wheel_radius_multiplier", both) for side in ("left", "right")]
        self.core = DiffDriveController(robot.manager, DiffDriveWheels(*joints, separation, *radii), self.settings())
        self.accept_commands()


class AckermannSteering(BaseController):
    """ackermann_steering_controller/AckermannSteeringController: angular.z of cmd_vel is the steering angle."""

    def __init__(self, robot: Robot, name: str, parameters: ControllerParameters) -> None:
        """Read the parameters; dimensions that they do not give are those of the model."""
        super().__init__(robot, name, parameters)
        p = parameters
        rear, steer = p.text("rear_wheel"), p.text("front_steer")
        (rear_index,), (steer_index,) = self.claim("velocity", [rear]), self.claim("position", [steer])
        base = self.size("wheel_separation_h", lambda: self.distance([rear, steer]))
        radius = self.size("wheel_radius", lambda: self.radius(rear))
        base *= p.length("wheel_separation_h_multiplier", 1.0)
        radius *= p.length("wheel_radius_multiplier", 1.0)
        wheels = AckermannWheels(rear_index, steer_index, base, radius)
        self.core = AckermannSteeringController(robot.manager, wheels, self.settings())
        self.accept_commands()


class MecanumDrive(BaseController):
    """mecanum_drive_controller/MecanumDriveController."""

    def __init__(self, robot: Robot, name: str, parameters: ControllerParameters) -> None:
        """Read the parameters; dimensions that they do not give are those of the model."""
        super().__init__(robot, name, parameters)
        corners = ("front_left", "back_left", "back_right", "front_right")
        names = [parameters.text(f"{corner}_wheel_joint") for corner in corners]
        along = self.size("wheel_separation_x", lambda: self.distance([names[0], names[1]]))
        across = self.size("wheel_separation_y", lambda: self.distance([names[0], names[3]]))
        k = (along + across) / 2 * parameters.length("wheel_separation_multiplier", 1.0)
        radius = self.size("wheel_radius", lambda: self.radius(names[0]))
        wheels = MecanumWheels(
            self.claim("velocity", names), k, radius * parameters.length("wheel_radius_multiplier", 1.0)
        )
        self.core = MecanumDriveController(robot.manager, wheels, self.settings())
        self.accept_commands(("linear.x", "linear.y", "angular.z"))


class FourWheelSteering(BaseController):
    """four_wheel_steering_controller/FourWheelSteeringController: cmd_vel, or the angles of both axles."""

    def __init__(self, robot: Robot, name: str, parameters: ControllerParameters) -> None:
        """Read the parameters; dimensions that they do not give are those of the model."""
        super().__init__(robot, name, parameters)
        p = parameters
        driven = [*p.pair("front_wheel"), *p.pair("rear_wheel")]
        steered = [*p.pair("front_steering"), *p.pair("rear_steering")]
        by_angles = not p.flag("enable_twist_cmd", default=False)
        wheels = FourWheelSteeringWheels(
            self.claim("velocity", driven),
            self.claim("position", steered),
            self.size("track", lambda: self.distance(steered[:2])),
            self.size("wheel_base", lambda: self.distance(driven[::2])),
            self.size("wheel_radius", lambda: self.radius(driven[0])),
            by_angles,
        )
        self.core = FourWheelSteeringController(robot.manager, wheels, self.settings(by_angles=by_angles))
        if by_angles:
            fields = ("speed", "front_steering_angle", "rear_steering_angle")
            kind = "four_wheel_steering_msgs/FourWheelSteering"
            self.subscribe_numbers("cmd_four_wheel_steering", kind, fields, self.core.commands())
        else:
            self.accept_commands()


def limits_of(parameters: ControllerParameters) -> list[_Limit]:
    """Return the limits of velocity, acceleration and jerk; those that are not given are None."""
    found: list[_Limit] = []
    for what in ("velocity", "acceleration", "jerk"):
        if not parameters.flag(f"has_{what}_limits", default=False):
            found.append(None)
            continue
        most = parameters.number(f"max_{what}")
        found.append((parameters.number(f"min_{what}", -most), most))
    return found
