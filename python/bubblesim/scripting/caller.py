# SPDX-License-Identifier: BSD-3-Clause
"""What the functions of ``sim``, ``simROS`` and ``simROS2`` need to know of their caller."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol

Hook = Callable[[], object]


@dataclass
class SharedData:
    """Data that all callers of one simulation share."""

    has_ros: bool
    signals: dict[tuple[type, str], Any] = field(default_factory=dict)
    """By kind and name."""
    cleared_scans: dict[str, float] = field(default_factory=dict)
    """When lidars measured what was cleared from their signals, s, by the signal's name."""

    def clear(self) -> None:
        """Forget all values."""
        self.signals.clear()
        self.cleared_scans.clear()


class Caller(Protocol):
    """A caller of functions: a child script, for example."""

    object_path: str
    object_handle: int
    shared: SharedData
    at_end: dict[Hashable, Hook]
    """Undoes what the caller made, by what it was; run when the caller ends."""
    in_each_step: dict[Hashable, Hook]
    """Run in each simulation step; must not raise."""
    programs: list[Any]
    """Programs that the caller started; they end with it."""

    def may_start(self, program: Path) -> bool:
        """Return whether the caller may start this program."""

    def callback(self, function: Callable[..., object] | str) -> Callable[..., None]:
        """Return a function that calls ``function``, or the caller's global of that name, and raises nothing."""

    def answering_callback(
        self, function: Callable[..., Any] | str, check: Callable[[object], None]
    ) -> Callable[..., Any]:
        """Return the same for a callback whose result matters; it raises ServiceError when ``check`` refuses it."""
