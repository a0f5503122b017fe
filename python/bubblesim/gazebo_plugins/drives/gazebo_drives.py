# SPDX-License-Identifier: BSD-3-Clause
"""The drives of Gazebo itself, DiffDrivePlugin and SkidSteerDrivePlugin.

In Gazebo they listen to a topic of its own transport; here to cmd_vel in the model's namespace. Their wheels' measures
are those of the model.
"""

from __future__ import annotations

import math

from bubblesim.controllers.differential_drive import DifferentialDrive
from bubblesim.gazebo_plugins.device import FASTEST, Device, PluginContext
from bubblesim.gazebo_plugins.drives.two_sided_drive import TwoSidedDrive, WheelGroup
from bubblesim.gazebo_plugins.drives.wheels import wheel_radius


class GazeboDiffDrive(Device):
    """Two wheels, by <left_joint> and <right_joint>."""

    left: tuple[str, ...] = ("left_joint",)
    right: tuple[str, ...] = ("right_joint",)

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters; joints have the parameters' names when these are left out."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace(of_model=True)
        left, right = ([self.joint(name, name) for name in names] for names in (self.left, self.right))
        apart = math.dist(self.world.pose(left[0])[:3], self.world.pose(right[0])[:3])
        radius = wheel_radius(self, left[0])
        if radius is None:
            raise p.fail(self.left[0], "names a joint whose wheel is neither a sphere nor a cylinder")
        torque = p.number("MaxForce", p.number("torque", math.inf, least=0.0), least=0.0)
        p.check()
        group = WheelGroup(DifferentialDrive(radius, apart, FASTEST), left, right)
        self._drive = TwoSidedDrive(self, group, torque=torque)
        self._drive.hear("cmd_vel")

    def reset(self) -> None:
        """Stand still."""
        self._drive.reset()

    def actuate(self) -> None:
        """Command the wheels."""
        self._drive.actuate()


class GazeboSkidSteerDrive(GazeboDiffDrive):
    """Four wheels, by joints of fixed names."""

    left = ("left_front", "left_rear")
    right = ("right_front", "right_rear")
