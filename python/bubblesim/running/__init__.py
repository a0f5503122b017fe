# SPDX-License-Identifier: BSD-3-Clause
"""Running the simulator and what belongs to it as processes, and watching it over ROS topics."""
