# SPDX-License-Identifier: BSD-3-Clause
"""Functions that the server itself has for pages: those that need files or other programs, not the simulator."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from typing import Any

from bubblesim.web import model_library


@dataclass(frozen=True)
class Served:
    """A function for pages."""

    call: Callable[..., Awaitable[Any]]
    """Takes the Page and the arguments."""
    edits: bool
    """It changes the simulation or a file."""


SERVED: dict[str, Served] = {
    "server.models": Served(model_library.models, edits=False),
    "server.preview": Served(model_library.preview, edits=False),
    "server.preview_mesh": Served(model_library.preview_mesh, edits=False),
    "server.preview_texture": Served(model_library.preview_texture, edits=False),
}
