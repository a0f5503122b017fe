# SPDX-License-Identifier: BSD-3-Clause
"""The parameters of controllers, which are dictionaries on the parameter server of ROS 1."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from bubblesim.program.addresses import master_uri
from bubblesim.program.ros_calls import FailedRosCallError, RosCallError, call


class ControllerError(ValueError):
    """What is wrong with the parameters of a controller."""


def read_parameter(name: str) -> Any:
    """Return a parameter, or the dictionary of a namespace, by its full name; None if there is none.

    :raises ControllerError: if the parameter server does not answer.
    """
    try:
        return call(master_uri(), "/gazebo_ros_control", "getParam", name)
    except FailedRosCallError:
        return None
    except RosCallError as error:
        raise ControllerError(f"no parameter server: {error}") from None


class ControllerParameters:
    """The parameters below a name, by type; an error names the parameter and what was found."""

    def __init__(self, name: str, values: Any) -> None:
        """:param name: full name, for messages."""
        self.name = name
        self._values: Mapping[str, Any] = values if isinstance(values, Mapping) else {}

    def fail(self, key: str, expected: str) -> ControllerError:
        """Return the error for a parameter that is not as expected."""
        found = self._values.get(key)
        return ControllerError(f"parameter {self.name}/{key}: expected {expected}, found {found!r}")

    def has(self, key: str) -> bool:
        """Return whether a parameter is given."""
        return key in self._values

    def names_given(self) -> list[str]:
        """Return the names of the parameters."""
        return list(self._values)

    def below(self, *keys: str) -> ControllerParameters:
        """Return the parameters in a nested dictionary; there are none if it is not given."""
        values: Any = self._values
        for key in keys:
            values = values.get(key) if isinstance(values, Mapping) else None
        return ControllerParameters("/".join((self.name, *keys)), values)

    def number(self, key: str, default: float | None = None) -> float:
        """Return a finite number; raise ControllerError if there is none and no default."""
        value = self._values.get(key, default)
        if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
            raise self.fail(key, "a number")
        return float(value)

    def length(self, key: str, default: float | None = None) -> float:
        """Return a number above 0."""
        value = self.number(key, default)
        if value <= 0.0:
            raise self.fail(key, "a number above 0")
        return value

    def flag(self, key: str, default: bool) -> bool:  # a default, as in the other functions
        """Return true or false; 0 and 1 are accepted."""
        value = self._values.get(key, default)
        if not isinstance(value, bool | int):
            raise self.fail(key, "true or false")
        return bool(value)

    def text(self, key: str, default: str | None = None) -> str:
        """Return a string; raise ControllerError if there is none and no default."""
        value = self._values.get(key, default)
        if not isinstance(value, str):
            raise self.fail(key, "a string")
        return value

    def names(self, key: str) -> list[str]:
        """Return a list of strings; one string is a list of one."""
        value = self._values.get(key)
        names = [value] if isinstance(value, str) else value
        if not isinstance(names, list) or not names or not all(isinstance(name, str) for name in names):
            raise self.fail(key, "a string or a list of strings")
        return names

    def pair(self, key: str) -> list[str]:
        """Return a list of two strings."""
        names = self.names(key)
        if len(names) != 2:
            raise self.fail(key, "two strings, left and right")
        return names

    def numbers(self, key: str, count: int, default: list[float]) -> list[float]:
        """Return a list of ``count`` numbers."""
        value = self._values.get(key, default)
        if (
            not isinstance(value, list)
            or len(value) != count
            or not all(isinstance(each, int | float) for each in value)
        ):
            raise self.fail(key, f"{count} numbers")
        return [float(each) for each in value]

    def dictionaries(self, key: str) -> list[ControllerParameters]:
        """Return a list of dictionaries; it is empty if it is not given."""
        value = self._values.get(key, [])
        if not isinstance(value, list) or not all(isinstance(each, Mapping) for each in value):
            raise self.fail(key, "a list of dictionaries")
        return [ControllerParameters(f"{self.name}/{key}", each) for each in value]
