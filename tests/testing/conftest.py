# SPDX-License-Identifier: BSD-3-Clause
"""Fixtures that are also provided to users."""

from bubblesim.testing.plugin import (
    _programs,
    controller,
    ros2_controller,
    ros2_domain,
    ros2_sim,
    ros_master,
    sim,
)

__all__ = ["_programs", "controller", "ros2_controller", "ros2_domain", "ros2_sim", "ros_master", "sim"]
