# SPDX-License-Identifier: BSD-3-Clause
"""`simROS` functions for parameters on the ROS master."""

from __future__ import annotations

import math
from typing import Any

from bubblesim import _core
from bubblesim.scripting.api.ros.context import RosContext
from bubblesim.scripting.api.ros.kinds import Int32

_INT32 = range(-(2**31), 2**31)
_KIND = {bool: "a bool", int: "an int", float: "a double", str: "a string", type(None): "a list or a dictionary"}


class RosParameters(RosContext):
    """Names are resolved like those of topics: absolute, or in the node's namespace.

    Reading waits for the master, at most one second; writing does not wait. Without a master, no parameter exists (with
    one warning), and written parameters are sent when a master appears. A new master starts without parameters.
    """

    def getParamString(self, name: str, default: str = "") -> tuple[bool, str]:
        """Return whether the parameter is a string, and its value or ``default``."""
        return self._get(name, str, default)

    def getParamBool(self, name: str, default: bool = False) -> tuple[bool, bool]:
        """Return whether the parameter is a bool, and its value or ``default``."""
        return self._get(name, bool, default)

    def getParamDouble(self, name: str, default: float = 0.0) -> tuple[bool, float]:
        """Return whether the parameter is a number, and its value or ``default``."""
        return self._get(name, float, default)

    def getParamInt(self, name: str, default: Int32 = 0) -> tuple[bool, int]:
        """Return whether the parameter is a number, and its value, rounded if necessary, or ``default``."""
        return self._get(name, int, default)

    def setParamString(self, name: str, value: str) -> None:
        """Set a parameter to a string."""
        self._bridge.set_parameter(name, value)

    def setParamBool(self, name: str, value: bool) -> None:
        """Set a parameter to a bool."""
        self._bridge.set_parameter(name, value)

    def setParamDouble(self, name: str, value: float) -> None:
        """Set a parameter to a number."""
        self._bridge.set_parameter(name, value)

    def setParamInt(self, name: str, value: Int32) -> None:
        """Set a parameter to a 32-bit integer."""
        self._bridge.set_parameter(name, value)

    def hasParam(self, name: str) -> bool:
        """Return whether the parameter is set."""
        return self._read(name)[0]

    def deleteParam(self, name: str) -> None:
        """Delete a parameter, if it is set."""
        self._bridge.delete_parameter(name)

    def searchParam(self, name: str) -> tuple[bool, str]:
        """Return whether the node's namespace or one above it has the parameter, and its full name there."""
        try:
            found = self._bridge.search_parameter(name)
        except _core.NoParameterServer as error:
            self._warn(str(error))
            found = None
        return found is not None, found or ""

    def _get(self, name: str, kind: type[Any], default: Any) -> tuple[bool, Any]:
        exists, value = self._read(name)
        if not exists:
            return False, default
        # The conversions of roscpp.
        if type(value) is kind:
            return True, value
        if kind is float and type(value) is int:
            return True, float(value)
        if kind is int and type(value) is float and math.isfinite(value):
            rounded = math.floor(value) if math.fmod(value, 1.0) < 0.5 else math.ceil(value)
            if rounded in _INT32:
                return True, rounded
        shown = "" if value is None else f" ({value!r})"
        self._warn(f"parameter '{name}' is {_KIND[type(value)]}{shown}, not {_KIND[kind]}: using the default")
        return False, default

    def _read(self, name: str) -> tuple[bool, Any]:
        try:
            answer: tuple[bool, Any] = self._bridge.get_parameter(name)
        except _core.NoParameterServer as error:
            self._warn(f"{error}: no parameter exists")
            return False, None
        return answer
