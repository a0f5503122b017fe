# SPDX-License-Identifier: BSD-3-Clause
"""Where the built programs lie."""

from __future__ import annotations

from pathlib import Path

from bubblesim import _core
from bubblesim.running.processes import RunError


def node_program() -> Path:
    """The simulator's node, <prefix>/lib/bubblesim/sim, of the build that this Python package belongs to."""
    # The module lies in <prefix>/lib/python3/dist-packages/bubblesim.
    program = Path(_core.__file__).parents[3] / "bubblesim" / "sim"
    if not program.is_file():
        raise RunError(f"the node is not built: there is no {program}; build the workspace with ROS")
    return program
