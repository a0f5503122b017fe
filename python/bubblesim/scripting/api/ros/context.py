# SPDX-License-Identifier: BSD-3-Clause
"""Common parts of all groups of `simROS` functions."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from typing import Any

from bubblesim import _core
from bubblesim.program.output import write_line
from bubblesim.scripting.api.ros.byte_arrays import ByteArrays
from bubblesim.scripting.caller import Caller


class RosContext:
    """The bridge, and the calling script."""

    _module = "simROS"  # module name in scripts
    _time_form = _core.messages.TimeForm.FLOAT  # of times in messages for the script

    def __init__(self, bridge: Any, simulation: Any, caller: Caller) -> None:
        """Bind the functions to one script."""
        self._bridge = bridge
        self._simulation = simulation
        self._caller = caller
        self._warned: set[object] = set()
        self._byte_arrays = ByteArrays(caller)

    def rosVersion(self) -> int:
        """Return the version of ROS that the module uses, 1 or 2; some messages have other fields in each."""
        return 2 if self._is_ros2 else 1

    @property
    def _is_ros2(self) -> bool:
        return bool(self._bridge.version == _core.messages.RosVersion.ROS2)

    def _warn(self, text: str) -> None:
        """Warn once for the script."""
        if text not in self._warned:
            self._warned.add(text)
            write_line(sys.stderr, f"warning: child script of {self._caller.object_path}: {text}")

    def _warn_of_truncation(self, where: str, truncations: Iterable[tuple[str, float]] | None) -> None:
        """Warn once per integer field about a truncated float.

        :param where: topic, service or action of the messages.
        :param truncations: fields and floats, as returned by ``_core.Bridge.check``.
        """
        for field, value in truncations or ():
            if (where, field) not in self._warned:
                self._warned.add((where, field))
                self._warn(f"{where}: float {value!r} in integer field {field} is truncated to {int(value)}")


def with_slashes(type_name: str) -> str:
    """Return the name of a type as package/Type; older scripts write package::Type."""
    return type_name.replace("::", "/")
