# SPDX-License-Identifier: BSD-3-Clause
"""ROS services and topics to control a running simulation."""
