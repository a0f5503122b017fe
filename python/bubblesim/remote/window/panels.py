# SPDX-License-Identifier: BSD-3-Clause
"""The dialogs, consoles and user interfaces that scripts have opened."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bubblesim.remote.window.window import Window


def get_panels(window: Window, revision: int = -1) -> dict[str, Any] | None:
    """Return the open panels with their ``revision``; None if it is the given one.

    A panel has ``handle``, ``kind`` and ``owner``; it and each of its parts have ``path``, ``kind``, ``values`` and
    ``parts``.
    """
    panels: dict[str, Any] | None = window.host.shared.panels.described(revision)
    return panels


def send_panel_event(window: Window, handle: int, path: list[int], event: str, value: Any = None) -> None:
    """Carry out what a user has done with a widget: the ``event`` is 'click', 'change', 'close' ..."""
    window.host.shared.panels.send(int(handle), [int(index) for index in path], str(event), value)


FUNCTIONS: tuple[Callable[..., Any], ...] = (get_panels, send_panel_event)
