# SPDX-License-Identifier: BSD-3-Clause
from ros2_peer import ros2_domain, ros2_peer
from ros_support import roscore

__all__ = ["ros2_domain", "ros2_peer", "roscore"]
