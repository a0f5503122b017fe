# SPDX-License-Identifier: BSD-3-Clause
"""Gazebo plugins, with the ROS interface of the originals."""
