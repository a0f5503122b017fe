# SPDX-License-Identifier: BSD-3-Clause
"""What every group of `simROS` functions works on."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from bubblesim import _core
from bubblesim.scripting.output import write_line

if TYPE_CHECKING:
    from bubblesim.scripting.child_script import ChildScript


class RosContext:
    """The bridge, and the script that calls."""

    _module = "simROS"  # its name in scripts
    _time_form = _core.messages.TimeForm.FLOAT  # of times in the messages that a script gets

    def __init__(self, bridge: Any, simulation: Any, script: ChildScript) -> None:
        """Bind the functions to one script."""
        self._bridge = bridge
        self._simulation = simulation
        self._script = script
        self._warned: set[str] = set()

    def _warn(self, text: str) -> None:
        """Warn in the script's name, once of the same."""
        if text not in self._warned:
            self._warned.add(text)
            write_line(sys.stderr, f"warning: child script of {self._script.object_path}: {text}")
