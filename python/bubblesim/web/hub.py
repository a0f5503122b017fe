# SPDX-License-Identifier: BSD-3-Clause
"""The simulator as all pages see it: its last frame, its events, and whether it is there."""

from __future__ import annotations

import asyncio
import contextlib
import sys
from collections import deque
from pathlib import Path
from typing import Any

import zmq.asyncio

from bubblesim._core import FrameReader
from bubblesim.program.output import write_line
from bubblesim.remote.control_lane import path_of
from bubblesim.remote.token import read
from bubblesim.web.node_client import NoAnswerError, NodeClient

_PERIOD = 1 / 60  # s between two polls of the frames
_IDLE = 0.25  # s, without pages
_MOST_EVENTS = 10_000
_BETWEEN_TRIES = 0.5  # s, for a simulator that is gone
_ANSWER = 10.0  # s


class Hub:
    """Follows one simulator."""

    def __init__(self, address: str, token_file: Path | None = None) -> None:
        """Remember the address of the node's remote API server and the file of its token; ``run`` does the work."""
        self.context = zmq.asyncio.Context()
        self.address = address
        self.token = ""
        self._token_file = token_file  # a node that begins makes it
        self.control: NodeClient | None = None
        """The lane for what a script that does not return must not hold up; None through a port, which has none."""
        if address.startswith("ipc://"):
            self.control = NodeClient(self.context, path_of(address))
        self.scene: dict[str, Any] = {}
        """What window.share returns; empty while there is no simulator."""
        self.session = 0
        """Number of scenes so far."""
        self.count = 0
        """Of the last frame."""
        self.changed = asyncio.Condition()
        """Notified of frames and events."""
        self.events: deque[tuple[int, str, Any]] = deque(maxlen=_MOST_EVENTS)
        self.next_event = 0
        self.pages = 0
        self._node = self.connect()
        self._reader: FrameReader | None = None
        self._packed: tuple[int, bytes] | None = None
        self._kept: dict[tuple[str, int], bytes] = {}
        self._problem = ""

    def connect(self) -> NodeClient:
        """Return a new client of the node."""
        return NodeClient(self.context, self.address, lambda: self.token)

    async def run(self) -> None:
        """Follow the simulator until cancelled."""
        while True:
            try:
                await self._begin()
                await self._follow()
            except NoAnswerError:
                pass  # it has not started yet, or has ended
            except Exception as error:  # whatever it is: the next simulator may be another one
                self._warn(error)
            if self.scene:
                self.scene = {}
                self._reader = None
                self.emit("gone", None)
                await self._notify()
            await asyncio.sleep(_BETWEEN_TRIES)

    def _warn(self, error: Exception) -> None:
        """Report why the simulator cannot be shown; once, not at each try."""
        problem = str(error) or type(error).__name__
        if problem != self._problem:
            self._problem = problem
            write_line(sys.stderr, f"warning: the window cannot show the simulator, and tries again: {problem}")

    async def _begin(self) -> None:
        if self._token_file is not None:
            if not self._token_file.exists():
                raise NoAnswerError(f"{self._token_file} is not there yet")
            self.token = read(self._token_file)
        scene = await self._node.call("window.share", timeout=_ANSWER)
        self._reader = FrameReader(scene["frames"])
        self._kept.clear()
        self._packed = None  # each scene counts its frames from 1
        self.count = 0
        self.events.clear()  # of the scene before
        self.session += 1
        self.scene = scene
        self.emit("scene", scene)
        await self._notify()

    async def _follow(self) -> None:
        assert self._reader is not None
        revision = notices = None
        next_event = self.scene["next_event"]
        looks = 0
        while True:
            head = self._reader.head()
            if head is not None:
                count, now_revision, now_notices, _, _, closed = head
                if closed:
                    return
                if now_notices != notices:
                    notices = now_notices
                    changes = await self._node.call("window.events", next_event, timeout=_ANSWER)
                    next_event = changes["next"]
                    for name, data in changes["events"]:
                        self.emit(name, data)
                    await self._notify()
                if revision is not None and now_revision != revision:
                    self.emit("models", None)
                revision = now_revision
                if count != self.count:
                    self.count = count
                    await self._notify()
            looks += 1
            if looks % 60 == 0 and not Path(self.scene["frames"]).exists():
                return
            await asyncio.sleep(_PERIOD if self.pages else _IDLE)

    def frame(self) -> bytes | None:
        """Return the last frame as the page reads it; None if there is none now."""
        if self._reader is None:
            return None
        if self._packed is None or self._packed[0] != self.count:
            try:
                packed = self._reader.packed()
            except RuntimeError as error:  # the memory of frames cannot be read
                self._warn(error)
                return None
            if packed is None:
                return None
            self._packed = (self.count, packed)
        return self._packed[1]

    async def kept(self, function: str, number: int) -> bytes:
        """Return the reply of window.mesh or window.texture, from memory if it was asked for before."""
        key = (function, number)
        if key not in self._kept:
            session = self.session
            reply = await self._node.forward(function, [number], connection="meshes")
            if session != self.session:
                return reply
            self._kept[key] = reply
        return self._kept[key]

    def emit(self, name: str, data: Any) -> None:
        """Send an event to all pages."""
        self.events.append((self.next_event, name, data))
        self.next_event += 1

    async def _notify(self) -> None:
        async with self.changed:
            self.changed.notify_all()

    async def close(self) -> None:
        """Leave the simulator."""
        with contextlib.suppress(zmq.ZMQError):
            self._node.close()
            if self.control is not None:
                self.control.close()
            self.context.destroy(0)
