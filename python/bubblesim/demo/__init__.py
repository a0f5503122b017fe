# SPDX-License-Identifier: BSD-3-Clause
"""The demonstration that scripts/demo runs: simulator and controller as a user starts them, watched over ROS topics."""
