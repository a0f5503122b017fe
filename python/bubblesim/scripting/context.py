# SPDX-License-Identifier: BSD-3-Clause
"""What every group of `sim` functions works on."""

from __future__ import annotations

import operator
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from bubblesim.scripting.constants import SimConstants

if TYPE_CHECKING:
    from bubblesim.scripting.child_script import ChildScript


class ApiContext(SimConstants):
    """The simulation and the script that calls."""

    def __init__(self, simulation: Any, script: ChildScript) -> None:
        """Bind the functions to one script."""
        self._simulation = simulation
        self._world = simulation.world
        self._script = script

    def _resolve(self, handle: Any) -> int:
        """Turn sim.handle_self and sim.handle_parent into the handle of an object."""
        number = as_handle(handle)
        if number >= 0:
            return number
        if number == self.handle_self:
            return self._script.object_handle
        if number == self.handle_parent:
            return int(self._world.parent(self._script.object_handle))
        raise ValueError(f"{number} is no handle of an object")


def as_handle(value: Any) -> int:
    """Whatever Python takes as an index; TypeError with a text for a script's author otherwise."""
    try:
        return operator.index(value)
    except TypeError:
        raise TypeError(f"expected the handle of an object, an integer, found {_shown(value)}") from None


def as_number(value: Any, what: str) -> float:
    """``value`` as a float; ``what`` names it in the TypeError."""
    if not isinstance(value, str):  # float('1') would take it
        try:
            return float(value)
        except (TypeError, ValueError):
            pass
    raise TypeError(f"{what} takes a number, found {_shown(value)}")


def as_numbers(values: Any, count: int, what: str) -> list[float]:
    """``values`` as ``count`` floats; ``what`` names them in the TypeError or ValueError."""
    if isinstance(values, str) or not isinstance(values, Iterable):
        raise TypeError(f"{what} takes {count} numbers, found {_shown(values)}")
    numbers = [as_number(value, what) for value in values]
    if len(numbers) != count:
        raise ValueError(f"{what} takes {count} numbers, found {len(numbers)}")
    return numbers


def _shown(value: Any) -> str:
    return "None" if value is None else f"{type(value).__name__} {repr(value)[:40]}"
