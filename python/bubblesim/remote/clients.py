# SPDX-License-Identifier: BSD-3-Clause
"""The remote clients that are there, and the steps that they hold back."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from typing import Any

from bubblesim.program.output import write_line
from bubblesim.remote.remote_client import ClientConnection, RemoteClient, Server
from bubblesim.remote.remote_sim import RemoteSim
from bubblesim.scripting.host.started_programs import end_programs

_MOST = 2000
_PERIOD = 1.0  # s between two checks for clients that are silent for too long
_TIMEOUT = 600.0  # s


class Clients:
    """By the uuid that each sends with its requests."""

    def __init__(self, server: Server, note: Callable[[bool], None]) -> None:
        """Begin without clients.

        :param note: called with whether there are clients.
        """
        self._server = server
        self._note = note
        self._clients: dict[str, RemoteClient] = {}
        self._modules: dict[str, RemoteSim] = {}  # by uuid
        self._stepping: list[RemoteClient] = []  # those in stepping mode
        self._created = 0
        self._runner: Any = None
        self._gate: int | None = None
        self._next_check = 0.0

    def __iter__(self) -> Iterator[RemoteClient]:
        """Return the clients in the order of their first requests."""
        return iter(self._clients.values())

    def begin_scene(self, host: Any) -> None:
        """Let the clients go on in the scene of a ScriptHost."""
        self._runner = host.runner
        for uuid, client in self._clients.items():
            client.begin_scene(host.shared)
            self._modules[uuid] = RemoteSim(self._runner, client)
        self.stepping_changed()

    def leave_scene(self) -> None:
        """Let the clients wait for the next scene."""
        self._gate = None  # it ends with the runner
        self._modules.clear()
        self._runner = None

    def client_of(self, connection: ClientConnection, uuid: str, timeout: float | None) -> RemoteClient:
        """Return the client of a request that has arrived on a connection."""
        client = self._clients.get(uuid)
        if client is None:
            if len(self._clients) >= _MOST:
                self.forget(min(self._clients.values(), key=lambda each: each.last_seen))
            self._created += 1
            client = RemoteClient(self._server, self._server.host.shared, self._created, timeout or _TIMEOUT)
            self._clients[uuid] = client
            self._modules[uuid] = RemoteSim(self._runner, client)
            self._note(True)
        if connection.client is not client:
            before, connection.client = connection.client, client
            if before is not None:
                before.connections.pop(connection.identity, None)
                if not before.connections:  # nothing can reach it any more
                    self.forget(before)
            client.connections[connection.identity] = connection
        client.last_seen = time.monotonic()
        return client

    def sim_of(self, uuid: str) -> RemoteSim:
        """Return the `sim` of a client."""
        return self._modules[uuid]

    def forget(self, client: RemoteClient) -> None:
        """End all that a client has."""
        for uuid in [uuid for uuid, known in self._clients.items() if known is client]:
            del self._clients[uuid], self._modules[uuid]
        self._note(bool(self._clients))
        for connection in list(client.connections.values()):
            connection.client = None
            connection.clear()
        client.connections.clear()
        end_programs(client.programs)
        client.programs = []
        for release in client.at_leave.values():
            try:
                release()
            except Exception as error:  # what it releases may be gone; the others follow
                write_line(sys.stderr, f"warning: the end of {client.object_path}: {error}")
        client.at_leave.clear()
        self.stepping_changed()

    def lose(self, connection: ClientConnection) -> bool:
        """Note that a connection is lost; return whether its client does not wait for a time any more."""
        client = connection.client
        if client is None:
            return False
        client.connections.pop(connection.identity, None)
        if not client.connections:
            self.forget(client)
        elif client.waits_for_time:  # perhaps on this connection
            client.waits_for_time = False
            return True
        return False

    def end_programs(self) -> None:
        """End the programs that clients have started."""
        end_programs([program for client in self for program in client.programs])

    # Stepping

    def stepping_changed(self) -> None:
        """Hold back steps if a client is in stepping mode."""
        self._stepping = [client for client in self if client.level]
        if self._stepping and self._gate is None:
            self._gate = self._runner.add_gate(self._may_step, self._why_not)
        elif not self._stepping and self._gate is not None:
            self._runner.remove_gate(self._gate)
            self._gate = None

    def note_step(self) -> None:
        """Count a step of those that clients have allowed."""
        for client in self._stepping:
            if client.granted:
                client.granted -= 1

    def end_stepping(self) -> None:
        """End the stepping modes of all clients."""
        for client in self:
            client.level = client.granted = 0
        self.stepping_changed()

    def _may_step(self) -> bool:
        now = time.monotonic()
        if now > self._next_check:
            self._next_check = now + _PERIOD
            if any(_is_silent(client, now) for client in self):
                self._runner.post(self._forget_silent)  # not here: it may remove this gate
        return all(client.granted or client.waits_for_time for client in self._stepping)

    def _why_not(self) -> str:
        names = ", ".join(client.object_path for client in self._stepping)
        return f"{names} steps the simulation"

    def _forget_silent(self) -> None:
        now = time.monotonic()
        for client in [client for client in self if _is_silent(client, now)]:
            write_line(sys.stderr, f"info: {client.object_path} is silent for {client.timeout:g} s and was released")
            self.forget(client)


def _is_silent(client: RemoteClient, now: float) -> bool:
    return now - client.last_seen > client.timeout and not any(
        connection.is_open for connection in client.connections.values()
    )
