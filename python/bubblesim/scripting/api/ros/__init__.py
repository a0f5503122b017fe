# SPDX-License-Identifier: BSD-3-Clause
"""The functions of ``simROS`` and ``simROS2``."""
