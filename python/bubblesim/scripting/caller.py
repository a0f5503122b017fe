# SPDX-License-Identifier: BSD-3-Clause
"""The callers of ``sim``, ``simROS`` and ``simROS2``, and the data they share."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol

Hook = Callable[[], object]


@dataclass
class SharedData:
    """Data shared by all callers of one simulation."""

    has_ros: bool
    signals: dict[tuple[type, str], Any] = field(default_factory=dict)
    """By kind and name."""
    cleared_scans: dict[str, float] = field(default_factory=dict)
    """Time of the last measurement, s, when a lidar's signal was cleared, by the signal's name."""

    def clear(self) -> None:
        """Delete all values."""
        self.signals.clear()
        self.cleared_scans.clear()


class Caller(Protocol):
    """A caller of functions, for example a child script."""

    object_path: str
    object_handle: int
    shared: SharedData
    at_end: dict[Hashable, Hook]
    """Functions that release the caller's resources, by resource; run when the caller ends."""
    in_each_step: dict[Hashable, Hook]
    """Run in each simulation step; must not raise."""
    programs: list[Any]
    """Programs that the caller started; they end with it."""

    def may_start(self, program: Path) -> bool:
        """Return whether the caller may start this program."""

    def callback(self, function: Callable[..., object] | str) -> Callable[..., None]:
        """Return a function that calls ``function``, or the caller's global of that name, and does not raise."""

    def answering_callback(
        self, function: Callable[..., Any] | str, check: Callable[[object], None]
    ) -> Callable[..., Any]:
        """Return the same for a callback with a result; it raises ServiceError if ``check`` rejects the result."""
