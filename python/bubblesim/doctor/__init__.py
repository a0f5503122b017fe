# SPDX-License-Identifier: BSD-3-Clause
"""Looks for what keeps bubblesim from working on this machine, and tells the cure."""
