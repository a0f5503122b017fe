# SPDX-License-Identifier: BSD-3-Clause
"""DiffDrivePlugin and SkidSteerDrivePlugin of Gazebo itself.

In Gazebo they subscribe to a topic of Gazebo's transport; here to cmd_vel in the model's namespace. The wheels'
dimensions are those of the model.
"""

from __future__ import annotations

import math

from bubblesim.controllers.differential_drive import DifferentialDrive
from bubblesim.gazebo_plugins.drives.two_sided_drive import TwoSidedDrive, WheelGroup
from bubblesim.gazebo_plugins.drives.wheels import wheel_radius
from bubblesim.gazebo_plugins.plugin import FASTEST, Plugin, PluginContext


class GazeboDiffDrive(Plugin):
    """Two wheels, by <left_joint> and <right_joint>."""

    left: tuple[str, ...] = ("left_joint",)
    right: tuple[str, ...] = ("right_joint",)

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters; the default of a joint name is the parameter's name."""
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
        self._drive.subscribe("cmd_vel")

    def reset(self) -> None:
        """Stop."""
        self._drive.reset()


class GazeboSkidSteerDrive(GazeboDiffDrive):
    """Four wheels, with joints of fixed names."""

    left = ("left_front", "left_rear")
    right = ("right_front", "right_rear")
