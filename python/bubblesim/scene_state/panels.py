# SPDX-License-Identifier: BSD-3-Clause
"""Panels that scripts open: dialogs, consoles and user interfaces of widgets. The window shows them; without a window
they keep their values."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

_MOST = 1000

Event = Callable[[str, Any], None]
"""Called with the name of the event, "click" or "change" for example, and the new value."""


@dataclass
class Widget:
    """A part of a panel. A layout, group or tab contains others."""

    number: int
    """With which scripts name it; 0 for parts that scripts do not name."""
    kind: str
    values: dict[str, Any] = field(default_factory=dict)
    """What is shown: plain values, lists and maps of them."""
    parts: list[Widget] = field(default_factory=list)
    on_event: Event | None = None

    def all(self) -> Iterator[Widget]:
        """Yield this widget and all in it."""
        yield self
        for part in self.parts:
            yield from part.all()

    def described(self, path: tuple[int, ...] = ()) -> dict[str, Any]:
        """Return it for viewers, with its path: the indices of the parts that lead to it."""
        parts = [part.described((*path, index)) for index, part in enumerate(self.parts)]
        return {"path": list(path), "kind": self.kind, "values": self.values, "parts": parts}


@dataclass
class Panel:
    """A dialog, console or user interface."""

    handle: int
    kind: str
    """'ui', 'dialog' or 'console'."""
    owner: str
    """Path of the object whose script has opened it."""
    root: Widget
    """Its values are title, visible, position, size and closeable."""
    result: Any = None
    """What a dialog returns."""

    def widget(self, number: int) -> Widget:
        """Return the widget with a number; raise LookupError if there is none."""
        found = next((each for each in self.root.all() if each.number == number and each is not self.root), None)
        if found is None:
            raise LookupError(f"the panel '{self.root.values.get('title', '')}' has no widget {number}")
        return found

    def at(self, path: list[int]) -> Widget:
        """Return the widget at a path, see Widget.described."""
        widget = self.root
        for index in path:
            widget = widget.parts[index]
        return widget


class Panels:
    """The open panels, by handle."""

    def __init__(self) -> None:
        """Create it without panels."""
        self.by_handle: dict[int, Panel] = {}
        self.revision = 0
        """Rises with each change."""
        self._opened = 0

    def open(self, kind: str, owner: str, root: Widget) -> Panel:
        """Add a panel."""
        if len(self.by_handle) >= _MOST:
            raise ValueError(f"a scene has at most {_MOST} panels: destroy some")
        self._opened += 1
        panel = self.by_handle[self._opened] = Panel(self._opened, kind, owner, root)
        self.changed()
        return panel

    def close(self, handle: int) -> None:
        """Remove a panel; nothing happens if it is not there."""
        if self.by_handle.pop(handle, None) is not None:
            self.changed()

    def panel(self, handle: int, kind: str) -> Panel:
        """Return a panel of a kind; raise LookupError if there is none."""
        panel = self.by_handle.get(handle)
        if panel is None or panel.kind != kind:
            raise LookupError(f"no {kind} has the handle {handle}")
        return panel

    def changed(self) -> None:
        """Note that viewers have to show something else."""
        self.revision += 1

    def described(self, revision: int) -> dict[str, Any] | None:
        """Return the panels for viewers that know a revision; None if nothing has changed since."""
        if revision == self.revision:
            return None
        return {
            "revision": self.revision,
            "panels": [
                {"handle": each.handle, "kind": each.kind, "owner": each.owner, **each.root.described()}
                for each in self.by_handle.values()
            ],
        }

    def send(self, handle: int, path: list[int], event: str, value: Any) -> None:
        """Carry out what a user has done with a widget."""
        panel = self.by_handle.get(handle)
        if panel is None:
            return  # closed meanwhile
        widget = panel.at(path)
        if widget.on_event is not None:
            widget.on_event(event, value)
            self.changed()
