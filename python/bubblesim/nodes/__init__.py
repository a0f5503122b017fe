# SPDX-License-Identifier: BSD-3-Clause
"""What the nodes in scripts share. Needs rospy."""
