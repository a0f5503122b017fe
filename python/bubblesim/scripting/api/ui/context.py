# SPDX-License-Identifier: BSD-3-Clause
"""Common parts of the functions of simUI."""

from __future__ import annotations

from typing import Any

from bubblesim.scene_state.panels import Panel, Widget
from bubblesim.scripting.caller import Caller


class UiContext:
    """The panels of the scene and the calling script."""

    def __init__(self, caller: Caller) -> None:
        """Bind the functions to one script."""
        self._caller = caller
        self._panels = caller.shared.panels

    def _panel(self, handle: int) -> Panel:
        return self._panels.panel(handle, "ui")

    def _widget(self, handle: int, number: int, *kinds: str) -> Widget:
        """Return a widget of one of these kinds, of any kind without them."""
        widget = self._panel(handle).widget(number)
        if kinds and widget.kind not in kinds:
            raise ValueError(f"the widget {number} is a {widget.kind}, not a {' or '.join(kinds)}")
        return widget

    def _set(self, widget: Widget, name: str, value: Any, *, quietly: bool = True) -> None:
        """Set a value; unless ``quietly``, call the script's function as if a user had done it."""
        widget.values[name] = value
        self._panels.changed()
        if not quietly and widget.on_event is not None:
            widget.on_event("change", value)
