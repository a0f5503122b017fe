# SPDX-License-Identifier: BSD-3-Clause
"""The parameters of a <plugin>, read by name and type."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

from bubblesim.messages.names import did_you_mean, nearest_names

_Value = TypeVar("_Value")
_FLAGS = {"true": True, "1": True, "false": False, "0": False}


class ParameterError(ValueError):
    """Problems of the parameters of a plugin, one line each."""


@dataclass(frozen=True)
class _Element:
    """An element with its own parameters, described as a plugin is."""

    name: str  # of the plugin, for messages
    filename: str
    parameters: list[Any]
    file: str
    line: int


class Parameters:
    """Names are accepted as in ROS 1, wheelSeparation, and as in ROS 2, wheel_separation.

    Invalid values are collected, and ``check`` raises an error for all of them.
    """

    def __init__(self, plugin: Any) -> None:
        """:param plugin: a ``bubblesim._core.PluginDescription``."""
        self.plugin = plugin
        self._found = {_key(parameter.name): parameter for parameter in reversed(plugin.parameters)}
        self._read: set[str] = {"ros_debug_level", "always_on", "ignition::corrected_offsets"}
        self._problems: list[str] = []
        self.hints: list[str] = []

    @property
    def title(self) -> str:
        """Return a title for messages: place, name and file name of the plugin; the element, if there is no plugin."""
        if not self.plugin.filename:
            return f"{where(self.plugin)}: <{self.plugin.name}>"
        return f"{where(self.plugin)}: plugin '{self.plugin.name}' ({self.plugin.filename})"

    def text(self, name: str, default: str) -> str:
        """Return a string without surrounding whitespace."""
        found = self.given(name)
        return default if found is None else found

    def given(self, name: str) -> str | None:
        """Return the text of a parameter, None if the plugin does not have it."""
        parameter = self._take(name)
        return None if parameter is None else parameter.text.strip()

    def number(self, name: str, default: float, least: float = -math.inf) -> float:
        """Return a finite number of at least ``least``."""
        return self._converted(name, *_number_reader(least), default)

    def length(self, name: str, default: float) -> float:
        """Return a number above 0."""
        return self.number(name, default, least=math.ulp(0.0))

    def lengths(self, name: str, default: float, count: int) -> list[float]:
        """Return numbers above 0 of ``count`` elements of that name; if there are fewer, the last one is repeated."""
        self._read.add(_key(name))
        elements = [each for each in self.plugin.parameters if _key(each.name) == _key(name)][:count]
        found = [self._value(name, each, *_number_reader(math.ulp(0.0)), default) for each in elements]
        found = found or [default]
        return found + found[-1:] * (count - len(found))

    def flag(self, name: str, default: bool) -> bool:  # a default, as in the other functions
        """Return true or false; 1 and 0 are accepted."""
        return self._converted(name, lambda text: _FLAGS[text.lower()], "true or false", default)

    def numbers(self, name: str, default: tuple[float, ...]) -> tuple[float, ...]:
        """Return as many finite numbers as the default has."""

        def read(text: str) -> tuple[float, ...]:
            numbers = tuple(map(float, text.split()))
            if len(numbers) != len(default) or not all(map(math.isfinite, numbers)):
                raise ValueError
            return numbers

        return self._converted(name, read, f"{len(default)} numbers", default)

    def deviations(self, name: str) -> tuple[float, ...]:
        """Return standard deviations: one for all axes, or three along x, y and z."""

        def read(text: str) -> tuple[float, ...]:
            numbers = tuple(map(float, text.split()))
            if len(numbers) not in (1, 3) or not all(math.isfinite(number) and number >= 0.0 for number in numbers):
                raise ValueError
            return numbers

        return self._converted(name, read, "one or three numbers (x, y and z) of at least 0", (0.0,))

    def choice(self, name: str, default: str, options: Mapping[str, _Value]) -> _Value:
        """Return the value of one of several words."""
        return self._converted(name, options.__getitem__, " or ".join(options), options[default])

    def names(self, name: str) -> list[str]:
        """Return the words of all elements of that name, separated by commas or spaces."""
        self._read.add(_key(name))
        strings = [each.text for each in self.plugin.parameters if _key(each.name) == _key(name)]
        return [word for text in strings for word in re.split(r"[,\s]+", text) if word]

    def ignore(self, *names: str) -> None:
        """Accept parameters that have no effect here."""
        self._read.update(map(_key, names))

    def child(self, name: str, below: str) -> str | None:
        """Return the text of a nested element, None if there is none."""
        parameter = self._take(name)
        children = parameter.children if parameter is not None else []
        return next((child.text.strip() for child in children if _key(child.name) == _key(below)), None)

    def inner(self, name: str) -> Parameters:
        """Return the parameters in a nested element; there are none if the plugin does not have it."""
        parameter = self._take(name)
        return self._within(self.plugin, []) if parameter is None else self._within(parameter, parameter.children)

    def all_of(self, name: str) -> list[Parameters]:
        """Return the parameters, and attributes, in all elements of that name."""
        self._read.add(_key(name))
        elements = [each for each in self.plugin.parameters if _key(each.name) == _key(name)]
        return [self._within(each, each.children) for each in elements]

    def fail(self, name: str, problem: str) -> ParameterError:
        """Return the error for a given or missing parameter without which the plugin cannot work."""
        self._note(name, problem)
        return ParameterError("\n".join(self._problems))

    def check(self) -> None:
        """Raise ParameterError if any problems were found."""
        if self._problems:
            raise ParameterError("\n".join(self._problems))

    def hint_if_missing(self, name: str, text: str) -> None:
        """Add a hint about a parameter that the plugin does not have."""
        if self.given(name) is None:
            self.hints.append(f"{where(self.plugin)}: plugin '{self.plugin.name}': <{name}> {text}")

    def unused(self) -> list[str]:
        """Return the names of parameters that were never read, with the nearest known names."""
        return [
            parameter.name + did_you_mean(nearest_names(key, sorted(self._read - set(self._found))))
            for key, parameter in self._found.items()
            if key not in self._read
        ]

    def _within(self, element: Any, parameters: list[Any]) -> Parameters:
        of = _Element(self.plugin.name, self.plugin.filename, parameters, element.file, element.line)
        inner = Parameters(of)
        inner._problems = self._problems  # they are those of the plugin
        return inner

    def _take(self, name: str) -> Any:
        self._read.add(_key(name))
        return self._found.get(_key(name))

    def _converted(self, name: str, convert: Callable[[str], _Value], expected: str, default: _Value) -> _Value:
        parameter = self._take(name)
        return default if parameter is None else self._value(name, parameter, convert, expected, default)

    def _value(
        self, name: str, parameter: Any, convert: Callable[[str], _Value], expected: str, default: _Value
    ) -> _Value:
        text = parameter.text.strip()
        try:
            return convert(text)
        except (KeyError, ValueError):
            self._note(name, f"is '{text}', it must be {expected}", parameter)
            return default

    def _note(self, name: str, problem: str, parameter: Any = None) -> None:
        found = parameter or self._found.get(_key(name), self.plugin)
        self._problems.append(f"{where(found)}: plugin '{self.plugin.name}': <{name}> {problem}")


def where(described: Any) -> str:
    """Return file:line of an element; only the file if the line is unknown."""
    return f"{described.file}:{described.line}" if described.line else str(described.file)


def _number_reader(least: float) -> tuple[Callable[[str], float], str]:
    """Return a function that reads such a number, and its description."""

    def read(text: str) -> float:
        number = float(text)
        if not (math.isfinite(number) and number >= least):
            raise ValueError
        return number

    expected = {-math.inf: "a number", math.ulp(0.0): "a number above 0"}
    return read, expected.get(least, f"a number of at least {least:g}")


def _key(name: str) -> str:
    """Return the common key of WheelSeparation, wheelSeparation and wheel_separation."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()
