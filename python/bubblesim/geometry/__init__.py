# SPDX-License-Identifier: BSD-3-Clause
"""Rotations, and poses in other frames."""
