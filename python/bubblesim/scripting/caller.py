# SPDX-License-Identifier: BSD-3-Clause
"""The callers of ``sim``, ``simROS`` and ``simROS2``."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from pathlib import Path
from typing import Any, Protocol

from bubblesim.scene_state.shared_data import SharedData

Hook = Callable[[], object]


class Caller(Protocol):
    """A caller of functions, for example a child script."""

    object_path: str
    object_handle: int
    """-1 for a remote client, which is not attached to an object."""
    is_remote: bool
    shared: SharedData
    at_end: dict[Hashable, Hook]
    """Functions that release the caller's resources, by resource; run when the caller ends."""
    in_each_step: dict[Hashable, Hook]
    """Run in each simulation step; must not raise."""
    stepping: int
    """Depth of nested setStepping calls outside of a thread."""
    uses_old_names: bool
    """It was logged that the caller uses names of older versions."""
    programs: list[Any]
    """Programs that the caller started; they end with it."""

    @property
    def in_lua(self) -> bool:
        """Whether the caller is a script in Lua."""

    @property
    def may_use_files(self) -> bool:
        """Whether the caller may read and write all files."""

    def may_start(self, program: Path) -> bool:
        """Return whether the caller may start this program."""

    def callback(self, function: Callable[..., object] | str) -> Callable[..., None]:
        """Return a function that calls ``function``, or the caller's global of that name, and does not raise."""

    def answering_callback(
        self, function: Callable[..., Any] | str, check: Callable[[object], None]
    ) -> Callable[..., Any]:
        """Return the same for a callback with a result; it raises ServiceError if ``check`` rejects the result."""
