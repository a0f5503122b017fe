# SPDX-License-Identifier: BSD-3-Clause
"""Controllers without ROS: sensor values in, commands out. The nodes in scripts/ add the ROS interface."""
