# SPDX-License-Identifier: BSD-3-Clause
"""Serves remote clients: a system of the node, whose sockets belong to the simulating thread.

The runner watches the descriptors of the sockets and calls ``_serve`` between steps, so a call finds the simulation at
rest. ZeroMQ's descriptors signal edges: after each use of a socket outside of ``_serve`` the runner is asked to call it
again.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import zmq
from zmq.utils.monitor import recv_monitor_message

from bubblesim._core import scene_folders
from bubblesim.output import write_line
from bubblesim.remote import protocol
from bubblesim.remote.clients import Clients
from bubblesim.remote.control_lane import ControlLane
from bubblesim.remote.frame_publisher import FramePublisher
from bubblesim.remote.function_calls import carry_out, info
from bubblesim.remote.listening import listen
from bubblesim.remote.remote_client import Line, Pending, RemoteClient
from bubblesim.remote.router import NO_DESCRIPTOR, Router
from bubblesim.remote.token import is_same, make_or_read
from bubblesim.remote.waiting_calls import WaitingCalls

_SLICE = 0.005  # s of requests between two looks at other commands
_MOST_NESTED = 50  # calls in callbacks in calls
_ENDED = "the simulator has ended"
_NEEDS_TOKEN = (
    "this node wants a token (--remote-token=FILE), the text in FILE: client.call('bubblesim.token', [TOKEN]) first, "
    "or bubblesim.connect(token=FILE)"
)
_TOO_OLD = "the client speaks a version of ZeroMQ's protocol before 3.0: use libzmq 4, JeroMQ 0.4 or a later one"
_MOST_REPORTED = 20  # errors of messages; a client could fill the disk


class RemoteServer:
    """Listens from its creation until ``close``, and serves the scene that it is attached to."""

    def __init__(
        self,
        address: str,
        port: int | None,
        note_clients: Callable[[bool], None],
        *,
        socket: str = "",
        token: str = "",
        trusted: bool = False,
        fixed_scene: str = "",
    ) -> None:
        """Listen on address:port, and on a Unix domain socket; see ``listen``.

        :param note_clients: called with whether there are clients; ``publish`` is called only then.
        :param socket: path of the Unix domain socket; empty: none.
        :param token: file with the text that clients must know; empty: they need none.
        :param trusted: clients may start all programs and use all files.
        :param fixed_scene: why clients cannot load another scene; empty if they can.
        :raises RuntimeError: if the address or the token's file cannot be used.
        """
        self.host: Any = None
        self.trusted = trusted
        self.fixed_scene = fixed_scene
        self.steps = 0
        self.scenes = 0  # number of scenes so far
        self.failure = ""  # why the scene that a client asked for is not there
        self.folders: list[Path] = []  # in which scenes are searched
        self._next_scene: Any = None
        self._runner: Any = None
        self._watch: Any = None
        self._watch_of_monitor: Any = None
        self._clients = Clients(self, note_clients)
        self._lines: dict[bytes, Line] = {}
        self._waiting = WaitingCalls(self._answer, self._wake_up)
        self._ending = False
        self._info = protocol.encode({"ret": [info()]})
        self._token = make_or_read(Path(token)) if token else ""
        self._context = zmq.Context()
        self._address = address if port is not None else ""
        self._frames: FramePublisher | None = None
        self._control: ControlLane | None = None
        self._monitor: Any = None
        self._reported = 0
        self._socket = listen(self._context, address, port, socket, wants_token=bool(token))
        try:
            self._router = Router(self._socket)
            if socket:
                self._control = ControlLane(self._context, socket)
            self._monitor = self._socket.get_monitor_socket(zmq.EVENT_DISCONNECTED)
            if trusted:
                write_line(
                    sys.stderr,
                    "warning: --remote-trusted: remote clients can start any program, and read and write scene files",
                )
        except BaseException:
            self._close_sockets()
            raise

    # Scenes

    def attach(self, host: Any, failure: str = "") -> None:
        """Serve the scene of a ScriptHost.

        :param failure: why the scene that a client asked for is not this one.
        """
        try:
            self._attach(host, failure)
        except BaseException:
            self.detach()  # wholly or not at all
            raise

    def _attach(self, host: Any, failure: str) -> None:
        self.host = host
        self.failure = failure
        self.scenes += 1
        self._runner = host.runner
        if not self.folders:
            first = Path(host.simulation.scene_file)
            self.folders = [first.absolute().parent] if first.name else []
            self.folders += [Path.cwd(), *map(Path, scene_folders())]
        self._watch = self._runner.watch(self._socket.getsockopt(zmq.FD), self._serve)
        self._watch_of_monitor = self._runner.watch(self._monitor.getsockopt(zmq.FD), self._serve_monitor)
        self._clients.begin_scene(host)
        if self._control is not None:
            self._control.show(host.runner)
        if self._frames is not None:
            self._frames.show(self.scenes, self._runner)
        self._runner.post(self._waiting.answer_due)
        self._look_again()  # the descriptors do not signal what came in between

    def detach(self) -> None:
        """Leave the scene; requests wait until the next one is attached."""
        if self._control is not None:
            self._control.show(None)
        self._close_watches()
        self._clients.leave_scene()
        if self._frames is not None:
            self._frames.show_none()
        self.host = self._runner = None

    def _close_watches(self) -> None:
        for watch in (self._watch, self._watch_of_monitor):
            if watch is not None:
                watch.close()
        self._watch = self._watch_of_monitor = None

    def change_scene(self, scene: Any) -> None:
        """Let the node go on with another ``bubblesim.Scene``."""
        self._next_scene = scene
        self._runner.end(wait=False)

    def take_next_scene(self) -> Any:
        """Return the scene for the node to go on with; None if it is to end."""
        scene, self._next_scene = self._next_scene, None
        return scene

    # Phases of the simulation

    def publish(self) -> None:
        """Count a step, and answer those who waited for it."""
        self.steps += 1
        self._clients.note_step()
        self._waiting.answer_done()

    def stop(self) -> None:
        """End the stepping of all clients."""
        self._clients.end_stepping()
        self._runner.post(self._waiting.answer_done)  # the state is stopped then

    def close(self) -> None:
        """Send an error to the clients that wait, and stop listening."""
        if self._socket.closed:
            return
        self._close_watches()
        self._ending = True
        if self.host is not None:
            self._serve()  # those who have just asked wait for an answer, too
        for line in list(self._lines.values()):
            if line.is_open:
                fits = line.pending is not None and line.pending.fits_the_end
                self._send(line, protocol.result(None) if fits else protocol.error(_ENDED))
        self._clients.end_programs()
        self._waiting.close()
        self._close_sockets()

    def _close_sockets(self) -> None:
        if self._frames is not None:
            self._frames.close()
        if self._control is not None:
            self._control.close()
        if self._monitor is not None:
            self._socket.disable_monitor()
            self._monitor.close(0)
        self._socket.close()
        self._context.term()

    # For clients

    def publish_frames(self) -> int:
        """Publish frames from now on, and return the port."""
        if not self._address:
            raise RuntimeError("frames are published on TCP: start the node with --remote")
        if self._frames is None:
            self._frames = FramePublisher(self._context, self._address)
            self._frames.show(self.scenes, self._runner)
        return self._frames.port

    def stepping_changed(self) -> None:
        """Hold back steps if a client is in stepping mode."""
        self._clients.stepping_changed()

    def after_commands(self, done: Callable[[], None]) -> None:
        """Call a function when the commands given so far have been carried out, and answer pending calls then."""

        def carried_out() -> None:
            done()
            self._waiting.answer_done()

        self._runner.post(carried_out)

    def deliver(self, client: RemoteClient) -> None:
        """Send the callbacks of a client if it waits for a reply."""
        for line in list(client.lines.values()):  # one that cannot be sent to is dropped
            if client.callbacks and line.is_open and not line.calls_back:
                self._pump(line)
        self._look_again()

    # Messages

    def _look_again(self) -> None:
        if self._watch is not None:
            self._watch.look_again()

    def _serve(self) -> bool:
        """Handle requests for a while; return whether there are more."""
        end = time.perf_counter() + _SLICE
        while self._router.has_input():
            if time.perf_counter() > end:
                return True
            try:
                self._receive()
            except Exception as error:  # one that leaves would end the watch for all clients
                self._report("a message of a remote client", error)
        return False

    def _receive(self) -> None:
        """Handle one message."""
        received = self._router.receive(self._lines)
        if received is None:
            return
        identity, data, descriptor = received
        if descriptor == NO_DESCRIPTOR:
            self._router.send(identity, protocol.error(_TOO_OLD))
            return
        if descriptor is not None:
            self._serve_monitor()  # before a descriptor is known under its new owner
            self._lines[identity] = Line(identity, None, descriptor)
        line = self._lines[identity]
        if data is None:
            self._send(line, protocol.error("expected a request of one part: use a REQ socket"))
            return
        try:
            self._handle(line, protocol.decode(data))
        except protocol.RequestError as error:
            self._send(line, protocol.error(str(error)))
        except Exception as error:
            line.clear()
            self._send(line, protocol.error_of(error))
            raise

    def _handle(self, line: Line, request: protocol.Request) -> None:
        if not request.uuid:
            self._send(line, protocol.encode({"success": False, "error": "the request has no uuid"}))
            return
        if self._token and not self._has_token(line, request):
            self._send(line, protocol.error(_NEEDS_TOKEN))
            return
        if request.function == "bubblesim.token":
            self._send(line, protocol.result(None))
            return
        client = self._clients.client_of(line, request.uuid, request.timeout)
        if request.function == protocol.EXECUTED:
            self._returned(line, request.arguments)
        elif request.function == protocol.END:
            self._clients.forget(client)
            self._send(line, protocol.encode({}))
        elif (line.is_open and not line.calls_back) or len(line.outer) >= _MOST_NESTED:
            self._send(line, protocol.error("the previous call on this socket is not answered yet"))
        else:
            if line.calls_back:  # a call in a callback
                line.begin_inner()
            self._call(line, request, client)

    def _has_token(self, line: Line, request: protocol.Request) -> bool:
        """Return whether a request or an earlier one of its line has the token."""
        sent = request.arguments[0] if request.function == "bubblesim.token" and request.arguments else request.token
        line.has_token = line.has_token or (isinstance(sent, str) and is_same(sent, self._token))
        return line.has_token

    def _call(self, line: Line, request: protocol.Request, client: RemoteClient) -> None:
        if self._ending:
            self._send(line, protocol.error(_ENDED))
            return
        try:
            if request.function == "zmqRemoteApi.info" and request.arguments == ["sim"]:
                reply = self._info
            else:
                value = carry_out(request, self._clients.sim_of(request.uuid), client)
                if isinstance(value, Pending) and not value.is_done():
                    self._waiting.add(line, value)
                    self._pump(line)
                    return
                if hasattr(value, "send"):
                    line.conversation = value
                    self._go_on(line, None)
                    return
                reply = protocol.result(value.result() if isinstance(value, Pending) else value)
        except Exception as error:
            reply = protocol.error_of(error)
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
        self._waiting.settle(line)
        self._pump(line)

    def _go_on(self, line: Line, value: Any) -> None:
        assert line.conversation is not None
        try:
            name, arguments = line.conversation.send(value)
            line.calls_back = True
            self._send(line, protocol.call(name, arguments))
            return
        except StopIteration as end:
            line.reply = protocol.result(end.value)
        except Exception as error:
            line.reply = protocol.error_of(error)
        line.conversation = None
        self._pump(line)

    def _pump(self, line: Line) -> None:
        """Send the next callback, or the reply if there is one."""
        if line.calls_back or line.conversation is not None:
            return
        if line.client is not None and line.client.callbacks:
            line.calls_back = True
            self._send(line, line.client.callbacks.take())
        elif line.reply is not None:
            reply, line.reply = line.reply, None
            if line.outer:
                line.end_inner()
                if line.pending is not None:
                    self._waiting.add(line, line.pending)
            self._send(line, reply)

    def _answer(self, line: Line) -> None:
        """Send the reply of a call that has waited."""
        self._pump(line)
        self._look_again()

    def _wake_up(self) -> None:
        """Answer what is due; called by another thread."""
        runner = self._runner  # None between two scenes: attaching the next one does the same
        if runner is not None:
            runner.post(self._waiting.answer_due)

    def _send(self, line: Line, message: bytes) -> None:
        if not self._router.send(line.identity, message):
            self._drop(line)

    def _report(self, what: str, error: Exception) -> None:
        self._reported += 1
        if self._reported <= _MOST_REPORTED:
            last = "; further ones are not reported" if self._reported == _MOST_REPORTED else ""
            write_line(sys.stderr, f"error: {what}: {type(error).__name__}: {error}{last}")

    # Broken connections

    def _serve_monitor(self) -> bool:
        """Forget the lines whose connection broke."""
        try:
            while True:
                descriptor = int(recv_monitor_message(self._monitor, zmq.NOBLOCK)["value"])
                for line in [line for line in self._lines.values() if line.descriptor == descriptor]:
                    self._drop(line)
        except zmq.Again:
            return False
        except Exception as error:  # see _serve
            self._report("the end of a connection of a remote client", error)
            return True

    def _drop(self, line: Line) -> None:
        self._lines.pop(line.identity, None)
        self._waiting.discard(line)
        line.clear()
        client = line.client
        if client is None:
            return
        client.lines.pop(line.identity, None)
        if not client.lines:
            self._clients.forget(client)
        elif client.waits_for_time:  # perhaps on this line
            client.waits_for_time = False
            self._waiting.answer_done()
