# SPDX-License-Identifier: BSD-3-Clause
"""Common code of the nodes in scripts/. Needs rospy."""
