# SPDX-License-Identifier: BSD-3-Clause
"""What the plugins of Gazebo's robots do, as ROS users know it."""
