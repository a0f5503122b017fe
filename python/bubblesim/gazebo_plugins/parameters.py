# SPDX-License-Identifier: BSD-3-Clause
"""The parameters of a <plugin>, read by name and type."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from typing import Any, TypeVar

from bubblesim.messages.names import did_you_mean, nearest_names

_Value = TypeVar("_Value")
_FLAGS = {"true": True, "1": True, "false": False, "0": False}


class ParameterError(ValueError):
    """What is wrong with the parameters of a plugin, a line for each."""


class Parameters:
    """Names are taken as they are in ROS 1, wheelSeparation, and in ROS 2, wheel_separation.

    What a parameter says wrongly is kept for ``check``, so that all of it is told at once.
    """

    def __init__(self, plugin: Any) -> None:
        """:param plugin: a ``bubblesim._core.PluginDescription``."""
        self.plugin = plugin
        self._found = {_key(parameter.name): parameter for parameter in reversed(plugin.parameters)}
        self._asked: set[str] = {"ros_debug_level", "always_on", "ignition::corrected_offsets"}
        self._problems: list[str] = []
        self.hints: list[str] = []

    @property
    def title(self) -> str:
        """What to call the plugin in a report: its place, name and file name."""
        return f"{where(self.plugin)}: plugin '{self.plugin.name}' ({self.plugin.filename})"

    def text(self, name: str, default: str) -> str:
        """A text, without spaces around it."""
        found = self.given(name)
        return default if found is None else found

    def given(self, name: str) -> str | None:
        """The text of a parameter, None when the plugin does not have it."""
        parameter = self._take(name)
        return None if parameter is None else parameter.text.strip()

    def number(self, name: str, default: float, least: float = -math.inf) -> float:
        """A finite number, ``least`` or more."""
        return self._converted(name, *_number_of_at_least(least), default)

    def length(self, name: str, default: float) -> float:
        """A number above 0."""
        return self.number(name, default, least=math.ulp(0.0))

    def lengths(self, name: str, default: float, count: int) -> list[float]:
        """Numbers above 0, of ``count`` elements of that name; if there are fewer, the last one counts for the rest."""
        self._asked.add(_key(name))
        elements = [each for each in self.plugin.parameters if _key(each.name) == _key(name)][:count]
        found = [self._value(name, each, *_number_of_at_least(math.ulp(0.0)), default) for each in elements]
        found = found or [default]
        return found + found[-1:] * (count - len(found))

    def flag(self, name: str, default: bool) -> bool:  # a default, as in the other readers
        """True or false; 1 and 0 will do."""
        return self._converted(name, lambda text: _FLAGS[text.lower()], "true or false", default)

    def numbers(self, name: str, default: tuple[float, ...]) -> tuple[float, ...]:
        """As many finite numbers as the default has."""

        def read(text: str) -> tuple[float, ...]:
            numbers = tuple(map(float, text.split()))
            if len(numbers) != len(default) or not all(map(math.isfinite, numbers)):
                raise ValueError
            return numbers

        return self._converted(name, read, f"{len(default)} numbers", default)

    def deviations(self, name: str) -> tuple[float, ...]:
        """Standard deviations: one for all axes, or three along x, y and z."""

        def read(text: str) -> tuple[float, ...]:
            numbers = tuple(map(float, text.split()))
            if len(numbers) not in (1, 3) or not all(math.isfinite(number) and number >= 0.0 for number in numbers):
                raise ValueError
            return numbers

        return self._converted(name, read, "one number or three (x, y and z) of at least 0", (0.0,))

    def choice(self, name: str, default: str, options: Mapping[str, _Value]) -> _Value:
        """One of some words; what stands for it."""
        return self._converted(name, options.__getitem__, " or ".join(options), options[default])

    def names(self, name: str) -> list[str]:
        """The words of all elements of that name; commas and spaces part them."""
        self._asked.add(_key(name))
        texts = [each.text for each in self.plugin.parameters if _key(each.name) == _key(name)]
        return [word for text in texts for word in re.split(r"[,\s]+", text) if word]

    def ignore(self, *names: str) -> None:
        """Parameters that are known and do nothing here."""
        self._asked.update(map(_key, names))

    def child(self, name: str, below: str) -> str | None:
        """The text of an element within another, None when there is none."""
        parameter = self._take(name)
        children = parameter.children if parameter is not None else []
        return next((child.text.strip() for child in children if _key(child.name) == _key(below)), None)

    def fail(self, name: str, problem: str) -> ParameterError:
        """To be raised: a parameter, given or left out, with which the plugin cannot work."""
        self._note(name, problem)
        return ParameterError("\n".join(self._problems))

    def check(self) -> None:
        """Raise ParameterError for all that was wrong so far."""
        if self._problems:
            raise ParameterError("\n".join(self._problems))

    def hint_if_missing(self, name: str, text: str) -> None:
        """Have a line told about a parameter that the plugin does not have."""
        if self.given(name) is None:
            self.hints.append(f"{where(self.plugin)}: plugin '{self.plugin.name}': <{name}> {text}")

    def unused(self) -> list[str]:
        """The names that nobody asked for, with a hint at what was meant."""
        return [
            parameter.name + did_you_mean(nearest_names(key, sorted(self._asked - set(self._found))))
            for key, parameter in self._found.items()
            if key not in self._asked
        ]

    def _take(self, name: str) -> Any:
        self._asked.add(_key(name))
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
    """file:line of what a file describes; the line only when it is known."""
    return f"{described.file}:{described.line}" if described.line else str(described.file)


def _number_of_at_least(least: float) -> tuple[Callable[[str], float], str]:
    """What reads such a number, and what to call it."""

    def read(text: str) -> float:
        number = float(text)
        if not (math.isfinite(number) and number >= least):
            raise ValueError
        return number

    expected = {-math.inf: "a number", math.ulp(0.0): "a number above 0"}
    return read, expected.get(least, f"a number of at least {least:g}")


def _key(name: str) -> str:
    """WheelSeparation, wheelSeparation and wheel_separation are one name."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()
