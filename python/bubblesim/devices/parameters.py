# SPDX-License-Identifier: BSD-3-Clause
"""The parameters of a <plugin>, read by name and type."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
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
        wanted = {-math.inf: "a number", math.ulp(0.0): "a number above 0"}.get(
            least, f"a number of at least {least:g}"
        )

        def read(text: str) -> float:
            number = float(text)
            if not (math.isfinite(number) and number >= least):
                raise ValueError
            return number

        return self._converted(name, read, default, wanted)

    def length(self, name: str, default: float) -> float:
        """A number above 0."""
        return self.number(name, default, least=math.ulp(0.0))

    def flag(self, name: str, default: bool) -> bool:  # a default, as in the other readers
        """True or false; 1 and 0 will do."""
        return self._converted(name, lambda text: _FLAGS[text.lower()], default, "true or false")

    def numbers(self, name: str, default: tuple[float, ...]) -> tuple[float, ...]:
        """As many finite numbers as the default has."""

        def read(text: str) -> tuple[float, ...]:
            numbers = tuple(map(float, text.split()))
            if len(numbers) != len(default) or not all(map(math.isfinite, numbers)):
                raise ValueError
            return numbers

        return self._converted(name, read, default, f"{len(default)} numbers")

    def choice(self, name: str, default: str, options: Mapping[str, _Value]) -> _Value:
        """One of some words; what stands for it."""
        return self._converted(name, options.__getitem__, options[default], " or ".join(options))

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

    def _converted(self, name: str, convert: Any, default: _Value, wanted: str) -> _Value:
        text = self.given(name)
        if text is None:
            return default
        try:
            value: _Value = convert(text)
        except (KeyError, ValueError):
            self._refuse(name, wanted)
            return default
        return value

    def _refuse(self, name: str, wanted: str) -> None:
        self._note(name, f"is '{self.given(name)}', it must be {wanted}")

    def _note(self, name: str, problem: str) -> None:
        found = self._found.get(_key(name), self.plugin)
        self._problems.append(f"{where(found)}: plugin '{self.plugin.name}': <{name}> {problem}")


def where(described: Any) -> str:
    """file:line of what a file describes; the line only when it is known."""
    return f"{described.file}:{described.line}" if described.line else str(described.file)


def _key(name: str) -> str:
    """WheelSeparation, wheelSeparation and wheel_separation are one name."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()
