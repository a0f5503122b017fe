# SPDX-License-Identifier: BSD-3-Clause
"""The programs of the packages in the folder compat, which have the names that launch files of Gazebo's robots use."""
