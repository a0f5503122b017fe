# SPDX-License-Identifier: BSD-3-Clause
"""Gazebo's plugins that publish what sensors measure."""
