# SPDX-License-Identifier: BSD-3-Clause
"""Stands in for the package of ROS 2 that xacro asks for packages: here those are of ROS 1."""
