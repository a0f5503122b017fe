# SPDX-License-Identifier: BSD-3-Clause
"""The plugin gazebo_ros_control, and the controllers of ros_control."""
