# SPDX-License-Identifier: BSD-3-Clause
"""Gazebo plugins for drives."""
