# SPDX-License-Identifier: BSD-3-Clause
"""The check of scene files, under its public name."""

from bubblesim.scene_files.check import problems_of

__all__ = ["problems_of"]
