# SPDX-License-Identifier: BSD-3-Clause
"""Threads of child scripts, which run in turns."""
