# SPDX-License-Identifier: BSD-3-Clause
"""What every group of `simROS` functions works on."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from typing import Any

from bubblesim import _core
from bubblesim.output import write_line
from bubblesim.scripting.caller import Caller


class RosContext:
    """The bridge, and the script that calls."""

    _module = "simROS"  # its name in scripts
    _time_form = _core.messages.TimeForm.FLOAT  # of times in the messages that a script gets

    def __init__(self, bridge: Any, simulation: Any, caller: Caller) -> None:
        """Bind the functions to one script."""
        self._bridge = bridge
        self._simulation = simulation
        self._caller = caller
        self._warned: set[object] = set()

    def _warn(self, text: str) -> None:
        """Warn in the script's name, once of the same."""
        if text not in self._warned:
            self._warned.add(text)
            write_line(sys.stderr, f"warning: child script of {self._caller.object_path}: {text}")

    def _warn_of_truncation(self, where: str, truncations: Iterable[tuple[str, float]] | None) -> None:
        """Warn once of each integer field that was given a float with a fraction.

        :param where: the topic, service or action whose messages these are.
        :param truncations: field and float, as ``_core.Bridge.check`` returns them.
        """
        for field, value in truncations or ():
            if (where, field) not in self._warned:
                self._warned.add((where, field))
                self._warn(
                    f"{where}: the integer field {field} got the float {value!r}, which is truncated to {int(value)}"
                )
