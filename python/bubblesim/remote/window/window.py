# SPDX-License-Identifier: BSD-3-Clause
"""What the functions of the window share in one scene, and its events."""

from __future__ import annotations

import weakref
from collections import deque
from collections.abc import Callable, Hashable
from dataclasses import dataclass
from typing import Any, Protocol

from bubblesim._core import SceneView

_MOST_EVENTS = 10_000
MOST_REMOVED = 100
"""Models that were removed and can be brought back."""


class WindowClient(Protocol):
    """Who calls functions of the window, such as a page."""

    at_leave: dict[Hashable, Callable[[], None]]
    """What it holds is released by these when it leaves."""


@dataclass(frozen=True)
class Source:
    """Where the SDFormat text of a model is, which "Save scene as" needs."""

    text: str | None = None
    original: str | None = None
    """Name of the model of the scene's file that it is, or is a copy of."""


@dataclass(frozen=True)
class ModelCopy:
    """A model as it was, to add it again."""

    copy: Any
    source: Source
    colours: list[list[float] | None]
    """That were set, in the order of its links."""
    numbers: list[dict[str, float]]
    """Likewise: masses and friction coefficients."""


class Window:
    """The scene that runs, as the page of the window sees it. Use it in the simulating thread."""

    def __init__(self, host: Any) -> None:
        """Share the frames of the scene from now on.

        :param host: the ScriptHost of the scene.
        """
        self.host = host
        self.runner = host.runner
        self.simulation = host.simulation
        self.view = SceneView()
        self.memory = self.runner.share_frames()
        self.client: WindowClient
        """Who calls the function that is carried out; set before each call."""
        self.springs: dict[Any, Any] = {}
        """With which clients pull at links, by client."""
        self.edits = host.shared.edits
        self.edits.colours.changed = self._recolour
        self.edits.tree_changed = self._tree_changed
        host.shared.dummies.changed = self._tree_changed
        self.removed: dict[int, ModelCopy] = {}
        """The last models that pages have removed, by number."""
        self._removals = 0
        self._events: deque[tuple[int, str, Any]] = deque(maxlen=_MOST_EVENTS)
        self.next_event = 0
        """Number of the next event."""
        self._recoloured: set[int] = set()
        self._has_other_tree = False

    def keep_removed(self, kept: ModelCopy) -> int:
        """Keep a model that is removed, and return its number; the oldest are forgotten."""
        number, self._removals = self._removals, self._removals + 1
        self.removed[number] = kept
        self.removed.pop(number - MOST_REMOVED, None)
        return number

    def emit(self, name: str, data: Any) -> None:
        """Send an event to all pages.

        :param data: plain values: numbers, strings, bytes, lists, maps.
        """
        self._events.append((self.next_event, name, data))
        self.next_event += 1
        self.memory.notice()

    def events(self, since: int) -> dict[str, Any]:
        """Return the events from number ``since`` on that are kept, and the number of the next one."""
        if self._recoloured:  # one event, however often a script sets colours
            colours = self.edits.colours.links
            changed = [[link, colours[link]] for link in self._recoloured if link in colours]
            self._recoloured.clear()
            self.emit("colours", changed)
        if self._has_other_tree:  # likewise
            self._has_other_tree = False
            self.emit("models", None)
        kept = [[name, data] for number, name, data in self._events if number >= since]
        return {"next": self.next_event, "events": kept}

    def _tree_changed(self) -> None:
        self._has_other_tree = True
        self.memory.notice()

    def _recolour(self, links: list[int]) -> None:
        self._recoloured.update(links)
        self.memory.notice()


_windows: weakref.WeakKeyDictionary[Any, Window] = weakref.WeakKeyDictionary()


def window_of(host: Any) -> Window:
    """Return the window of a scene; the first call makes it."""
    window = _windows.get(host)
    if window is None:
        window = _windows[host] = Window(host)
    return window
