# SPDX-License-Identifier: BSD-3-Clause
"""Running the simulator and other programs as processes, and observing it over ROS topics."""
