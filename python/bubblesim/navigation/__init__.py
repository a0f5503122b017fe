# SPDX-License-Identifier: BSD-3-Clause
"""Maps of the plane and navigation without ROS; the nodes in scripts/ connect them to topics."""
