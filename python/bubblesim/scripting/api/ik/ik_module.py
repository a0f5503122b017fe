# SPDX-License-Identifier: BSD-3-Clause
"""The module `simIK` of one child script."""

from __future__ import annotations

from typing import Any

from bubblesim.scripting.api.functions import script_module
from bubblesim.scripting.api.ik.groups import GroupFunctions
from bubblesim.scripting.api.ik.objects import IkObjectFunctions
from bubblesim.scripting.api.ik.searches import SearchFunctions
from bubblesim.scripting.api.ik.transfer import TransferFunctions


@script_module("simIK")
class SimIk(TransferFunctions, SearchFunctions, GroupFunctions, IkObjectFunctions):
    """Inverse kinematics in environments of its own: trees of dummies and joints, copied from the scene or made.
    Forward kinematics and Jacobians are those of Orocos KDL."""

    handle_world = -1
    handle_all = -2
    handle_parent = -11
    constraint_x = 1
    constraint_y = 2
    constraint_z = 4
    constraint_alpha_beta = 8
    constraint_gamma = 16
    constraint_position = 7
    constraint_orientation = 24
    constraint_pose = 31
    method_pseudo_inverse = 0
    method_damped_least_squares = 1
    method_jacobian_transpose = 2
    method_undamped_pseudo_inverse = 3
    result_not_performed = 0
    result_success = 1
    result_fail = 2
    jointmode_passive = 0
    jointmode_ik = 2
    jointtype_revolute = 10
    jointtype_prismatic = 11
    jointtype_spherical = 12
    objecttype_joint = 1
    objecttype_dummy = 4
    group_enabled = 1
    group_ignoremaxsteps = 2
    group_restoreonbadlintol = 4
    group_restoreonbadangtol = 8
    group_stoponlimithit = 16
    group_avoidlimits = 64
    calc_notperformed = 1
    calc_cannotinvert = 2
    calc_notwithintolerance = 16
    calc_stepstoobig = 32
    calc_limithit = 64

    def createDebugOverlay(self, environment: int, tip: int, base: int = -1) -> int:
        """Accept a drawing of a chain, which is not made; return 0."""
        self._environment(environment)
        return 0

    def eraseDebugOverlay(self, overlay: int) -> None:
        """Accept the handle of a drawing."""

    def getFailureDescription(self, reason: int) -> str:
        """Return the reason of a failure of handleGroup in words."""
        words = {
            self.calc_notperformed: "no joint of the group is in IK mode, or no tip has a target",
            self.calc_cannotinvert: "the Jacobian cannot be inverted",
            self.calc_notwithintolerance: "the tips are not within tolerance",
        }
        return "; ".join(text for bit, text in words.items() if reason & bit) or "no failure"

    def getConfigForTipPose(
        self,
        environment: int,
        group: int,
        joints: Any,
        threshold: float = 0.1,
        seconds: float = 0.5,
        metric: Any = None,
        callback: Any = None,
        data: Any = None,
        *more: Any,
    ) -> list[float] | None:
        """Return a configuration of joints that fulfils a group (old name of findConfig); ``seconds`` above 10, and
        negative ones, are ms."""
        limit = abs(seconds) / 1000 if seconds < 0 or seconds > 10 else seconds
        return self.findConfig(environment, group, joints, threshold, limit, metric, callback, data)
