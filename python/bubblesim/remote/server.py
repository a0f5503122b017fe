# SPDX-License-Identifier: BSD-3-Clause
"""Serves remote clients: a system of the node, whose sockets belong to the simulating thread.

The runner watches the descriptors of the sockets and calls ``_serve`` between steps, so a call finds the simulation at
rest. ZeroMQ's descriptors signal edges: after each use of a socket its events are read again.
"""

from __future__ import annotations

import ipaddress
import math
import sys
import time
from collections.abc import Callable
from typing import Any

import zmq
from zmq.utils.monitor import recv_monitor_message

from bubblesim._core import RunState
from bubblesim.output import write_line
from bubblesim.remote import protocol
from bubblesim.remote.function_calls import carry_out, info
from bubblesim.remote.remote_client import Line, Pending, RemoteClient
from bubblesim.remote.remote_sim import RemoteSim
from bubblesim.scripting.host.started_programs import end_programs

_SLICE = 0.005  # s of requests between two looks at other commands
_LINGER = 1  # ms for the next request of a client that has just got its reply
_MOST_CLIENTS = 2000
_MOST_NESTED = 50  # calls in callbacks in calls
_BETWEEN_LOOKS = 1.0  # s between two looks for clients that are silent for too long
_ENDED = "the simulator has ended"


class RemoteServer:
    """Listens from its creation until ``close``."""

    def __init__(self, host: Any, address: str, port: int) -> None:
        """Listen on address:port; port 0 takes a free one.

        :param host: the ScriptHost of the node.
        :raises RuntimeError: if the address cannot be used.
        """
        self.host = host
        self.steps = 0
        self._runner = host.runner
        self._clients: dict[str, RemoteClient] = {}  # by uuid
        self._modules: dict[str, RemoteSim] = {}  # by uuid
        self._lines: dict[bytes, Line] = {}
        self._created = 0
        self._gate: int | None = None
        self._next_look = 0.0
        self._ending = False
        self._info = protocol.encode({"ret": [info()]})
        self._context = zmq.Context()
        self._socket = self._listen(address, port)
        self._monitor = self._socket.get_monitor_socket(zmq.EVENT_DISCONNECTED)
        self._watches = [
            self._runner.watch(self._socket.getsockopt(zmq.FD), self._serve),
            self._runner.watch(self._monitor.getsockopt(zmq.FD), self._serve_monitor),
        ]

    def _listen(self, address: str, port: int) -> zmq.Socket[bytes]:
        socket = self._context.socket(zmq.ROUTER)
        socket.setsockopt(zmq.LINGER, 200)  # ms for the last replies
        socket.setsockopt(zmq.MAXMSGSIZE, protocol.MOST_BYTES + 1024)
        socket.setsockopt(zmq.RCVHWM, 2)  # a client has one request at a time; more wait in its own memory
        socket.setsockopt(zmq.SNDHWM, 16)  # replies that are not read
        socket.setsockopt(zmq.ROUTER_MANDATORY, 1)  # sending to a client that is gone is an error
        socket.setsockopt(zmq.HEARTBEAT_IVL, 10_000)  # ms; finds machines that are gone
        socket.setsockopt(zmq.HEARTBEAT_TIMEOUT, 30_000)
        try:
            socket.bind(f"tcp://{address}:{port if port else '*'}")
        except zmq.ZMQError as error:
            socket.close(0)
            self._context.term()
            raise RuntimeError(
                f"cannot listen on {address}:{port}: {error.strerror}; another port: --remote=PORT"
            ) from None
        where = socket.getsockopt_string(zmq.LAST_ENDPOINT).rstrip("\0")
        write_line(sys.stderr, f"info: remote clients can connect to {where}")
        if not _is_loopback(address):
            write_line(sys.stderr, f"warning: all who reach {address} can control the simulation: there is no password")
        return socket

    # Phases of the simulation

    def publish(self) -> None:
        """Count a step, and answer those who waited for it."""
        self.steps += 1
        if not self._clients:
            return
        for client in self._clients.values():
            if client.granted:
                client.granted -= 1
        self._answer_pending()

    def stop(self) -> None:
        """End the stepping of all clients."""
        for client in self._clients.values():
            client.level = client.granted = 0
        self.stepping_changed()
        self._runner.post(self._answer_pending)  # the state is stopped then

    def close(self) -> None:
        """Send an error to the clients that wait, and stop listening."""
        if self._socket.closed:
            return
        for watch in self._watches:
            watch.close()
        self._ending = True
        self._serve()  # those who have just asked wait for an answer, too
        for line in list(self._lines.values()):
            if line.is_open:
                fits = line.pending is not None and line.pending.fits_the_end
                self._send(line, protocol.result(None) if fits else protocol.error(_ENDED))
        end_programs([program for client in self._clients.values() for program in client.programs])
        self._socket.disable_monitor()
        self._monitor.close(0)
        self._socket.close()
        self._context.term()

    # For clients

    def stepping_changed(self) -> None:
        """Hold back steps if a client is in stepping mode."""
        wanted = any(client.level for client in self._clients.values())
        if wanted and self._gate is None:
            self._gate = self._runner.add_gate(self._may_step, self._why_not)
        elif not wanted and self._gate is not None:
            self._runner.remove_gate(self._gate)
            self._gate = None

    def _may_step(self) -> bool:
        now = time.monotonic()
        if now > self._next_look:
            self._next_look = now + _BETWEEN_LOOKS
            if any(_is_silent(client, now) for client in self._clients.values()):
                self._runner.post(self._forget_silent)  # not here: it may remove this gate
        return all(c.granted or c.waits_for_time or not c.level for c in self._clients.values())

    def _why_not(self) -> str:
        names = ", ".join(client.object_path for client in self._clients.values() if client.level)
        return f"{names} steps the simulation"

    def after_commands(self, done: Callable[[], None]) -> None:
        """Call a function when the commands given so far have been carried out, and answer pending calls then."""

        def carried_out() -> None:
            done()
            self._answer_pending()

        self._runner.post(carried_out)

    def deliver(self, client: RemoteClient) -> None:
        """Send the callbacks of a client if it waits for a reply."""
        for line in client.lines.values():
            if client.callbacks and line.is_open and not line.calls_back:
                self._pump(line)
        self._look_again()

    # Messages

    def _serve(self) -> bool:
        """Handle requests for a while; return whether there are more."""
        end = time.perf_counter() + _SLICE
        while True:
            try:
                self._receive()
            except zmq.Again:
                if not self._may_linger() or not self._socket.poll(_LINGER):
                    return False
            if time.perf_counter() > end:
                return self._has_input()

    def _may_linger(self) -> bool:
        """Return whether no step is late if this waits for the next request, which saves the change of threads."""
        if self._ending:
            return False
        if self._runner.state != RunState.RUNNING or math.isfinite(self._runner.speed):
            return True
        return self._gate is not None and not self._may_step()

    def _look_again(self) -> None:
        """Do what the descriptor may not signal any more, after the socket was used outside of _serve."""
        if not self._socket.closed and self._has_input():
            self._runner.post(lambda: self._look_again() if self._serve() else None)

    def _has_input(self) -> bool:
        return bool(int(self._socket.getsockopt(zmq.EVENTS)) & zmq.POLLIN)

    def _receive(self) -> None:
        """Handle one message; raise zmq.Again if there is none."""
        identity = self._socket.recv(zmq.NOBLOCK)
        line = self._lines.get(identity)
        if line is not None:
            parts = self._socket.recv_multipart()
        else:
            self._serve_monitor()  # before a descriptor is known under its new owner
            frames = self._socket.recv_multipart(copy=False)
            line = self._lines[identity] = Line(identity, None, int(frames[-1].get(zmq.SRCFD)))
            parts = [frame.bytes for frame in frames]
        if len(parts) != 2 or parts[0]:
            self._send(line, protocol.error("expected a request of one part: use a REQ socket"))
            return
        try:
            request = protocol.decode(parts[1])
        except protocol.RequestError as error:
            self._send(line, protocol.error(str(error)))
            return
        self._handle(line, request)

    def _handle(self, line: Line, request: protocol.Request) -> None:
        if not request.uuid:
            self._send(line, protocol.encode({"success": False, "error": "the request has no uuid"}))
            return
        client = self._client_of(line, request)
        client.last_seen = time.monotonic()
        if request.function == protocol.EXECUTED:
            self._returned(line, request.arguments)
        elif request.function == protocol.END:
            self._forget(client)
            self._send(line, protocol.encode({}))
        elif (line.is_open and not line.calls_back) or len(line.outer) >= _MOST_NESTED:
            self._send(line, protocol.error("the previous call on this socket is not answered yet"))
        else:
            if line.calls_back:  # a call in a callback
                line.begin_inner()
            self._call(line, request, client)

    def _call(self, line: Line, request: protocol.Request, client: RemoteClient) -> None:
        if self._ending:
            self._send(line, protocol.error(_ENDED))
            return
        try:
            if request.function == "zmqRemoteApi.info" and request.arguments == ["sim"]:
                reply = self._info
            else:
                value = carry_out(request, self._modules[request.uuid], client)
                if isinstance(value, Pending) and not value.is_done():
                    line.pending = value
                    self._pump(line)
                    return
                if hasattr(value, "send"):
                    line.conversation = value
                    self._go_on(line, None)
                    return
                reply = protocol.result(value.result() if isinstance(value, Pending) else value)
        except Exception as error:
            reply = protocol.error(_text(error))
        line.reply = reply
        self._pump(line)

    def _returned(self, line: Line, values: list[Any]) -> None:
        """Handle the end of a callback in the client."""
        if not line.calls_back:
            self._send(line, protocol.error("no callback was sent"))
            return
        line.calls_back = False
        if line.conversation is not None:
            self._go_on(line, values[0] if len(values) == 1 else tuple(values) or None)
            return
        self._settle(line)
        self._pump(line)

    def _go_on(self, line: Line, value: Any) -> None:
        assert line.conversation is not None
        try:
            name, arguments = line.conversation.send(value)
            line.calls_back = True
            self._send(line, protocol.encode({"func": name, "args": list(arguments)}))
            return
        except StopIteration as end:
            line.reply = protocol.result(end.value)
        except Exception as error:
            line.reply = protocol.error(_text(error))
        line.conversation = None
        self._pump(line)

    def _pump(self, line: Line) -> None:
        """Send the next callback, or the reply if there is one."""
        if line.calls_back or line.conversation is not None:
            return
        if line.client is not None and line.client.callbacks:
            name, arguments = line.client.callbacks.popleft()
            try:
                message = protocol.encode({"func": name, "args": list(arguments)})
            except TypeError as error:
                message = protocol.encode({"func": name, "args": [str(error)]})
            line.calls_back = True
            self._send(line, message)
        elif line.reply is not None:
            reply, line.reply = line.reply, None
            if line.outer:
                line.end_inner()
            self._send(line, reply)

    def _answer_pending(self) -> None:
        sent = False
        for line in list(self._lines.values()):
            if self._settle(line):
                self._pump(line)
                sent = True
        if sent:
            self._look_again()

    def _settle(self, line: Line) -> bool:
        """Turn a pending call into its reply if it is done."""
        pending = line.pending
        if pending is None or not pending.is_done():
            return False
        line.pending = None
        try:
            line.reply = protocol.result(pending.result())
        except Exception as error:
            line.reply = protocol.error(_text(error))
        return True

    def _send(self, line: Line, message: bytes) -> None:
        parts = [line.identity, b"", message]
        try:
            try:
                self._socket.send_multipart(parts, zmq.NOBLOCK)
            except zmq.Again:
                self._socket.getsockopt(zmq.EVENTS)  # learns here how much the peer has read
                self._socket.send_multipart(parts, zmq.NOBLOCK)
        except zmq.ZMQError:  # it is gone, or does not read
            self._drop(line)

    # Who is there

    def _client_of(self, line: Line, request: protocol.Request) -> RemoteClient:
        client = self._clients.get(request.uuid)
        if client is None:
            if len(self._clients) >= _MOST_CLIENTS:
                self._forget(min(self._clients.values(), key=lambda each: each.last_seen))
            self._created += 1
            client = RemoteClient(self, self.host.shared, self._created, request.timeout or 600.0)
            self._clients[request.uuid] = client
            self._modules[request.uuid] = RemoteSim(self._runner, client)
        if line.client is not client:
            if line.client is not None:
                line.client.lines.pop(line.identity, None)
            line.client = client
            client.lines[line.identity] = line
        return client

    def _serve_monitor(self) -> bool:
        """Forget the lines whose connection broke."""
        while True:
            try:
                descriptor = int(recv_monitor_message(self._monitor, zmq.NOBLOCK)["value"])
            except zmq.Again:
                return False
            for line in [line for line in self._lines.values() if line.descriptor == descriptor]:
                self._drop(line)

    def _drop(self, line: Line) -> None:
        self._lines.pop(line.identity, None)
        line.clear()
        if line.client is not None:
            line.client.lines.pop(line.identity, None)
            if not line.client.lines:
                self._forget(line.client)

    def _forget(self, client: RemoteClient) -> None:
        for uuid in [uuid for uuid, known in self._clients.items() if known is client]:
            del self._clients[uuid], self._modules[uuid]
        for line in list(client.lines.values()):
            line.client = None
            line.clear()
        client.lines.clear()
        end_programs(client.programs)
        client.programs = []
        self.stepping_changed()

    def _forget_silent(self) -> None:
        now = time.monotonic()
        for client in [client for client in self._clients.values() if _is_silent(client, now)]:
            write_line(sys.stderr, f"info: {client.object_path} is silent for {client.timeout:g} s and was released")
            self._forget(client)


def _is_silent(client: RemoteClient, now: float) -> bool:
    return now - client.last_seen > client.timeout and not any(line.is_open for line in client.lines.values())


def _text(error: Exception) -> str:
    return str(error) or type(error).__name__


def _is_loopback(address: str) -> bool:
    try:
        return address == "localhost" or ipaddress.ip_address(address).is_loopback
    except ValueError:
        return False
