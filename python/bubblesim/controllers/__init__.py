# SPDX-License-Identifier: BSD-3-Clause
"""Controllers as plain Python: what they see goes in, what they command comes out. scripts/ adds the ROS."""
