# SPDX-License-Identifier: BSD-3-Clause
"""LiftDrag of gz-sim and of Gazebo: the lift and drag of a wing."""

from __future__ import annotations

import math

from bubblesim import _core
from bubblesim.gazebo_plugins.plugin import Plugin, PluginContext


class LiftDrag(Plugin):
    """Parameters and defaults are those of gz-sim. As there, the moment coefficients have no effect."""

    acts_without_ros = True

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        link = self.link("link_name", "")
        joint = self.joint("control_joint_name", "") if p.given("control_joint_name") else -1
        p.ignore("cma", "cma_stall", "robotNamespace", "topic_name")
        parameters = {
            "area": p.number("area", 1.0, least=0.0),
            "density": p.number("air_density", 1.2041, least=0.0),
            "centre_of_pressure": p.numbers("cp", (0.0, 0.0, 0.0)),
            "forward": p.numbers("forward", (1.0, 0.0, 0.0)),
            "upward": p.numbers("upward", (0.0, 0.0, 1.0)),
            "radial_symmetry": p.flag("radial_symmetry", default=False),
            "alpha0": p.number("a0", 0.0),
            "lift_slope": p.number("cla", 1.0),
            "drag_slope": p.number("cda", 0.01),
            "alpha_stall": p.number("alpha_stall", math.pi / 2, least=0.0),
            "lift_slope_stall": p.number("cla_stall", 0.0),
            "drag_slope_stall": p.number("cda_stall", 1.0),
            "control_slope": p.number("control_joint_rad_to_cl", 4.0),
        }
        p.check()
        wing = _core.LiftDrag(self.simulation, link, control_joint=joint, **parameters)
        context.endpoints.append(wing.remove)
