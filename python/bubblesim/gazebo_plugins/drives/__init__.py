# SPDX-License-Identifier: BSD-3-Clause
"""Gazebo's plugins that move robots."""
