# SPDX-License-Identifier: BSD-3-Clause
"""The connection of one page: its calls, the frames and the events.

The first message of a page is the token, as text. All others are binary. Those of the page are CBOR lists:
``[number, function, arguments, connection]`` is a call, ``[count]`` reports that a frame was drawn. Those of the server
are frames, which begin with a zero byte (see FrameReader.packed), and CBOR lists: ``[number, reply]`` answers a call,
``[null, name, data]`` is an event.
"""

from __future__ import annotations

import asyncio
import contextlib
from typing import Any

import cbor2
from aiohttp import WSMsgType, web

from bubblesim._core import cbor_decode
from bubblesim.remote.control_lane import COMMANDS
from bubblesim.web.access import Access, is_read_only
from bubblesim.web.foreign_files import ForeignFile
from bubblesim.web.hub import Hub
from bubblesim.web.node_client import NodeError
from bubblesim.web.ros_markers import PageMarkers
from bubblesim.web.ros_topics import PageTopics
from bubblesim.web.served import SERVED
from bubblesim.web.tools import TOOLS

_MOST_BYTES = 64 * 1024 * 1024
_MOST_CALLS = 64  # without an answer; the page sends fewer (web/src/link.js)
_IN_FLIGHT = 2  # frames that were sent and not drawn yet
_KEPT = {"window.mesh", "window.texture"}
_SERVED = SERVED | TOOLS


async def serve_page(request: web.Request, access: Access, hub: Hub, *, may_edit: bool) -> web.WebSocketResponse:
    """Serve a page until it closes, if it has the token."""
    socket = web.WebSocketResponse(max_msg_size=_MOST_BYTES, heartbeat=20, compress=False)
    await socket.prepare(request)
    transport = request.transport
    if await access.lets_in(socket, transport):
        if transport is not None:
            transport.set_write_buffer_limits(high=65536)
        await Page(hub, socket, may_edit=may_edit).serve()
    return socket


class Page:
    """A page, from its token to its end."""

    def __init__(self, hub: Hub, socket: web.WebSocketResponse, *, may_edit: bool) -> None:
        """Prepare the connection.

        :param may_edit: the page may call functions that change the simulation or files.
        """
        self.hub = hub
        self.may_edit = may_edit
        self.node = hub.connect()
        self.topics = PageTopics()
        self.markers = PageMarkers()
        self.foreign = ForeignFile()
        self._socket = socket
        self._calls: set[asyncio.Task[None]] = set()
        self._sent: list[int] = []

    async def serve(self) -> None:
        """Serve the page until it closes. What it has begun ends first: calls, their threads and subscriptions."""
        async with contextlib.AsyncExitStack() as ends:
            ends.push_async_callback(self.topics.close)
            ends.push_async_callback(self.markers.close)
            ends.callback(self.node.close)
            ends.callback(self.foreign.close)
            async with asyncio.TaskGroup() as tasks:
                await self._receive_all(tasks)

    async def _receive_all(self, tasks: asyncio.TaskGroup) -> None:
        self.hub.pages += 1
        changes = tasks.create_task(self._send_events())
        try:
            async for message in self._socket:
                if message.type == WSMsgType.BINARY:
                    await self._receive(message.data, tasks)
        finally:
            self.hub.pages -= 1
            for task in (changes, *self._calls):
                task.cancel()

    async def _receive(self, data: bytes, tasks: asyncio.TaskGroup) -> None:
        try:
            message = cbor_decode(data)
        except ValueError:
            return
        match message:
            case [int(drawn)]:
                self._sent = [count for count in self._sent if count != drawn]
                async with self.hub.changed:
                    self.hub.changed.notify_all()
            case [int(number), str(), list(), str()] if len(self._calls) >= _MOST_CALLS:
                error = f"this page waits for the answers of {_MOST_CALLS} calls: it can call more when they are there"
                await self._send_reply(number, _encode({"err": error}))
            case [int(number), str(function), list(arguments), str(connection)]:
                call = tasks.create_task(self._answer(number, function, arguments, connection))
                self._calls.add(call)
                call.add_done_callback(self._calls.discard)

    async def _answer(self, number: int, function: str, arguments: list[Any], connection: str) -> None:
        await self._send_reply(number, await self._reply(function, arguments, connection))

    async def _send_reply(self, number: int, reply: bytes) -> None:
        await self._send(b"\x82" + cbor2.dumps(number) + reply)

    async def _reply(self, function: str, arguments: list[Any], connection: str) -> bytes:
        """Return the reply to a call as CBOR, a map with ``ret`` or ``err``."""
        try:
            if function in _SERVED:
                served = _SERVED[function]
                if served.edits and not self.may_edit:
                    raise NodeError(f"{function}: this window is read-only")
                value = await served.call(self, *arguments)
                return _encode({"ret": [value]})
            if not self.may_edit and not is_read_only(function):
                raise NodeError(f"{function}: this window is read-only")
            if function in COMMANDS and self.hub.control is not None:
                return await self.hub.control.forward(function, [])
            if function in _KEPT:
                return await self.hub.kept(function, int(arguments[0]))
            return await self.node.forward(function, arguments, connection)
        except Exception as error:
            return _encode({"err": str(error) or type(error).__name__})

    async def _send_events(self) -> None:
        """Send events and frames: all events, and of the frames the last one when the page is ready for it."""
        hub = self.hub
        next_event = hub.next_event
        last: tuple[int, int] = (0, 0)
        scene = hub.scene
        await self._event("hello", {"edit": self.may_edit})
        if scene:
            await self._event("scene", scene)
        while not self._socket.closed:
            for number, name, data in list(hub.events):
                if number >= next_event:
                    next_event = number + 1
                    await self._event(name, data)
            now = (hub.session, hub.count)
            if now != last and len(self._sent) < _IN_FLIGHT:
                frame = hub.frame()
                if frame is not None:
                    last = now
                    self._sent.append(int.from_bytes(frame[4:8], "little"))
                    await self._send(frame)
                    continue
            async with hub.changed:
                if hub.next_event == next_event:
                    with contextlib.suppress(TimeoutError):
                        async with asyncio.timeout(1.0):  # wait_for() may lose a cancellation
                            await hub.changed.wait()

    async def _event(self, name: str, data: Any) -> None:
        await self._send(cbor2.dumps([None, name, data]))

    async def _send(self, message: bytes) -> None:
        with contextlib.suppress(ConnectionError):  # the page has closed: ``serve`` ends
            await self._socket.send_bytes(message)


def _encode(reply: dict[str, Any]) -> bytes:
    encoded: bytes = cbor2.dumps(reply)
    return encoded
