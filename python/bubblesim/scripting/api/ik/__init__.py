# SPDX-License-Identifier: BSD-3-Clause
"""Inverse kinematics: the functions of simIK."""
