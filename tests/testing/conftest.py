# SPDX-License-Identifier: BSD-3-Clause
"""The fixtures that users have, too."""

from bubblesim.testing.plugin import _programs, controller, ros_master, sim

__all__ = ["_programs", "controller", "ros_master", "sim"]
