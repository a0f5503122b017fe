# SPDX-License-Identifier: BSD-3-Clause
"""What every group of `simROS` functions works on."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from bubblesim import _core

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
