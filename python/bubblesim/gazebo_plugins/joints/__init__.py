# SPDX-License-Identifier: BSD-3-Clause
"""Gazebo plugins that command and report joints."""
