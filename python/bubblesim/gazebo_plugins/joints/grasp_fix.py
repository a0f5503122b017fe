# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_grasp_plugin's libgazebo_grasp_fix: what the fingers of an arm press is attached to its palm."""

from __future__ import annotations

import math

from bubblesim._core import Grasp
from bubblesim.gazebo_plugins.parameters import Parameters
from bubblesim.gazebo_plugins.plugin import Plugin, PluginContext


class GraspFix(Plugin):
    """Parameters and defaults are those of the plugin, also of its first version, which has one arm."""

    acts_without_ros = True

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        rate = p.length("update_rate", 5.0)  # Hz
        most = int(p.number("max_grip_count", 10.0, least=1.0))
        threshold = int(p.number("grip_count_threshold", float(most // 2), least=0.0))
        options = {
            "rate": rate,
            "min_contacts": 1,
            "min_angle": math.radians(min(p.number("forces_angle_tolerance", 120.0, least=90.0), 180.0)),
            "attach_updates": threshold,
            "detach_updates": max(most - threshold - 1, 0),
            "slack": p.number("release_tolerance", 0.005, least=0.0),
        }
        p.ignore("disable_collisions_on_attach", "contact_topic")
        arms = p.all_of("arm")
        if not arms and p.given("palm_link") is None:
            raise p.fail("arm", "is missing: it has a <palm_link> and <gripper_link>s")
        described = [self._read_arm(arm) for arm in arms or [p]]
        p.check()
        for palm, fingers in described:
            grasp = Grasp(self.simulation, palm, fingers, **options)
            context.endpoints.append(grasp.remove)

    def _read_arm(self, arm: Parameters) -> tuple[int, list[int]]:
        arm.ignore("arm_name")
        palm = self.part_named(arm.text("palm_link", ""), "palm_link", "link")
        fingers = [self.part_named(name, "gripper_link", "link") for name in arm.names("gripper_link")]
        if not fingers:
            raise arm.fail("gripper_link", "is missing: a link that presses what is grasped")
        return palm, fingers
