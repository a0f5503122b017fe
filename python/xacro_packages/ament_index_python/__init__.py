# SPDX-License-Identifier: BSD-3-Clause
"""Replaces the ROS 2 package that xacro uses to find packages; here it finds ROS 1 packages."""
