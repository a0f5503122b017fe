# SPDX-License-Identifier: BSD-3-Clause
"""Delays of the actions and observations of many worlds, under their public name."""

from bubblesim.learning.delayed_rows import DelayedRows

__all__ = ["DelayedRows"]
