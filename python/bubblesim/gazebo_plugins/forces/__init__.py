# SPDX-License-Identifier: BSD-3-Clause
"""Plugins that push links: propellers, wings, water and wind. Their forces act without ROS too."""
