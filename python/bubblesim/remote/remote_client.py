# SPDX-License-Identifier: BSD-3-Clause
"""A remote client as a caller of `sim`, and its connections."""

from __future__ import annotations

import time
from collections.abc import Callable, Hashable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol

from bubblesim.remote import protocol
from bubblesim.remote.callback_queue import CallbackQueue
from bubblesim.remote.later_replies import Conversation, Pending
from bubblesim.scene_state.shared_data import SharedData
from bubblesim.scripting.allowed_programs import is_allowed
from bubblesim.scripting.caller import Hook


class Server(Protocol):
    """The server, as its clients see it."""

    steps: int
    """Number of steps since the start of the server."""
    host: Any
    scenes: int
    """Number of scenes since the start of the server."""
    failure: str
    """Why the scene that a client asked for is not there; empty if it is."""
    fixed_scene: str
    """Why clients cannot load another scene; empty if they can."""
    trusted: bool
    """Clients may start all programs and use all files."""
    folders: list[Path]
    """In which scenes are searched."""

    def change_scene(self, scene: Any) -> None:
        """Let the node go on with another ``bubblesim.Scene``."""

    def publish_frames(self) -> tuple[int, bytes]:
        """Publish frames from now on; return the port, and the secret that readers must know."""

    def stepping_changed(self) -> None:
        """A client has changed its level of stepping."""

    def after_commands(self, done: Callable[[], None]) -> None:
        """Call a function when the commands given so far have been carried out, and answer pending calls then."""

    def deliver(self, client: RemoteClient) -> None:
        """Send the callbacks of a client if it waits for a reply."""


@dataclass
class ClientConnection:
    """A socket of a client. It has one call at a time, which may wait for the calls in its callbacks."""

    identity: bytes
    client: RemoteClient | None
    descriptor: int
    """Of the operating system, to find the connection when it breaks."""
    pending: Pending | None = None
    reply: bytes | None = None
    """Sent when the client has returned from the callbacks before it."""
    conversation: Conversation | None = None
    calls_back: bool = False
    """A callback was sent, and the client has not returned from it."""
    has_token: bool = False
    """The client has sent the token, if one is wanted."""
    outer: list[tuple[Pending | None, bytes | None, Conversation | None]] = field(default_factory=list)
    """The calls whose callbacks have made the current one."""

    def begin_inner(self) -> None:
        """Set the current call aside: its callback makes a call."""
        self.outer.append((self.pending, self.reply, self.conversation))
        self.pending = self.reply = self.conversation = None
        self.calls_back = False

    def end_inner(self) -> None:
        """Go back to the call whose callback has made a call."""
        self.pending, self.reply, self.conversation = self.outer.pop()
        self.calls_back = True

    def clear(self) -> None:
        """Forget all calls."""
        self.outer.clear()
        self.pending = self.reply = self.conversation = None
        self.calls_back = False

    @property
    def is_open(self) -> bool:
        """Return whether the client waits for a reply."""
        return self.calls_back or self.pending is not None or self.reply is not None or self.conversation is not None


@dataclass(eq=False)
class RemoteClient:
    """A program outside; see Caller."""

    server: Server
    shared: SharedData
    number: int
    timeout: float
    object_handle: int = -1
    is_remote: bool = True
    in_lua: bool = False
    at_end: dict[Hashable, Hook] = field(default_factory=dict)
    in_each_step: dict[Hashable, Hook] = field(default_factory=dict)
    at_leave: dict[Hashable, Callable[[], None]] = field(default_factory=dict)
    """What the client holds in this scene is released by these when it leaves, or its connection breaks."""
    programs: list[Any] = field(default_factory=list)
    connections: dict[bytes, ClientConnection] = field(default_factory=dict)
    callbacks: CallbackQueue = field(default_factory=CallbackQueue)
    level: int = 0
    """Of nested setStepping."""
    granted: int = 0
    """Steps that may run."""
    stepping: int = 0
    uses_old_names: bool = False
    waits_for_time: bool = False
    """In sim.wait, where all steps may run."""
    last_seen: float = field(default_factory=time.monotonic)
    object_path: str = ""

    def __post_init__(self) -> None:
        """Name the client for messages."""
        self.object_path = f"remote client {self.number}"

    def may_start(self, program: Path) -> bool:
        """Return whether the client may start this program: those that a Lua script may start, unless it is trusted."""
        return self.server.trusted or is_allowed(program, self.server.host.allowed_programs)

    @property
    def may_use_files(self) -> bool:
        """Whether the client may read and write all files."""
        return self.server.trusted

    def begin_scene(self, shared: SharedData) -> None:
        """Go on with another scene."""
        self.shared = shared
        self.at_end.clear()
        self.in_each_step.clear()
        self.at_leave.clear()
        self.callbacks.clear()
        self.granted = 0
        self.waits_for_time = False

    def callback(self, function: Callable[..., object] | str) -> Callable[..., None]:
        """Return a function that calls a function of the client."""
        if not isinstance(function, RemoteCallback):
            raise TypeError(f"a callback must be a function, found {type(function).__name__}")
        return function

    def answering_callback(
        self, function: Callable[..., Any] | str, check: Callable[[object], None]
    ) -> Callable[..., Any]:
        """Raise RuntimeError: a step cannot wait for a remote client."""
        raise RuntimeError("a remote client cannot provide a service: a step would wait for it")


@dataclass(frozen=True)
class RemoteCallback:
    """A function of a client. A call is sent when the client waits for a reply, at the latest with its next call."""

    client: RemoteClient
    name: str

    def __call__(self, *arguments: Any) -> None:
        """Have the client call it; of more than 1000 calls or 16 MiB that wait, the oldest are dropped."""
        try:
            message = protocol.call(self.name, arguments)
        except TypeError as error:
            message = protocol.call(self.name, [str(error)])
        self.client.callbacks.put(message)
        self.client.server.deliver(self.client)
