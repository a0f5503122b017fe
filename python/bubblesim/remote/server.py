# SPDX-License-Identifier: BSD-3-Clause
"""The remote API server: a system of the node, which outlasts the scenes that its clients load."""

from __future__ import annotations

import sys
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import zmq

from bubblesim._core import scene_folders
from bubblesim.program.output import write_line
from bubblesim.remote.calls import Calls
from bubblesim.remote.client_socket import ClientSocket
from bubblesim.remote.clients import Clients
from bubblesim.remote.control_lane import ControlLane
from bubblesim.remote.frame_publisher import FramePublisher
from bubblesim.remote.listening import listen
from bubblesim.remote.remote_client import ClientConnection, RemoteClient
from bubblesim.remote.requests import Requests
from bubblesim.remote.token import make_or_read
from bubblesim.remote.waiting_stops import WaitingStops


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
        :param token: file with the secret that clients must know; empty: they need none.
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
        secret = make_or_read(Path(token)) if token else ""
        self._context = zmq.Context()
        self._address = address if port is not None else ""
        self._frames: FramePublisher | None = None
        with ExitStack() as undo:
            undo.callback(self._context.term)
            listening = listen(self._context, address, port, socket, wants_token=bool(token))
            undo.callback(listening.close, 0)
            self._socket = ClientSocket(listening, self._handle, self._note_lost)
            undo.callback(self._socket.close)
            self._control = ControlLane(self._context, socket) if socket else None
            if self._control is not None:
                undo.callback(self._control.close)
            self._clients = Clients(self, note_clients)
            self._calls = Calls(self._socket, self._wake_up)
            self._requests = Requests(self._socket, self._clients, self._calls, secret)
            self._stops = WaitingStops(
                self._socket.router, self._socket.connections, self._requests.constant_reply, self._requests.has_token
            )
            undo.pop_all()
        if trusted:
            write_line(
                sys.stderr,
                "warning: --remote-trusted: remote clients can start any program, and read and write scene files",
            )

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
        self._socket.watch(self._runner)
        self._clients.begin_scene(host)
        host.stops_elsewhere.append(self._stop_waits)
        if self._control is not None:
            self._control.show(host.runner)
        if self._frames is not None:
            self._frames.show(self.scenes, self._runner)
        self._runner.post(self._calls.answer_due)
        self._socket.serve_again()  # the descriptors do not signal what came in between

    def detach(self) -> None:
        """Leave the scene; requests wait until the next one is attached."""
        if self._control is not None:
            self._control.show(None)
        self._socket.end_watch()
        self._clients.leave_scene()
        if self._frames is not None:
            self._frames.show_none()
        self.host = self._runner = None

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
        self._calls.answer_done()

    def stop(self) -> None:
        """End the stepping of all clients."""
        self._clients.end_stepping()
        self._runner.post(self._calls.answer_done)  # the state is stopped then

    def close(self) -> None:
        """Send an error to the clients that wait, and stop listening."""
        if self._socket.is_closed:
            return
        self._socket.end_watch()
        self._calls.refuse()
        if self.host is not None:
            self._socket.serve()  # those who have just asked wait for an answer, too
        self._calls.end()
        self._clients.end_programs()
        if self._frames is not None:
            self._frames.close()
        if self._control is not None:
            self._control.close()
        self._socket.close()
        self._context.term()

    # For clients

    def publish_frames(self) -> tuple[int, bytes]:
        """Publish frames from now on; return the port, and the secret that readers must know."""
        if not self._address:
            raise RuntimeError("frames are published on TCP: start the node with --remote")
        if self._frames is None:
            self._frames = FramePublisher(self._context, self._address)
            self._frames.show(self.scenes, self._runner)
        return self._frames.port, self._frames.secret

    def stepping_changed(self) -> None:
        """Hold back steps if a client is in stepping mode."""
        self._clients.stepping_changed()

    def after_commands(self, done: Callable[[], None]) -> None:
        """Call a function when the commands given so far have been carried out, and answer pending calls then."""

        def carried_out() -> None:
            done()
            self._calls.answer_done()

        self._runner.post(carried_out)

    def deliver(self, client: RemoteClient) -> None:
        """Send the callbacks of a client if it waits for a reply."""
        self._calls.deliver(client)

    # Events

    def _handle(self, connection: ClientConnection, data: bytes, is_answered: bool) -> None:
        self._requests.handle(connection, data, is_answered)

    def _note_lost(self, connection: ClientConnection) -> None:
        self._calls.drop(connection)
        if self._clients.lose(connection):
            self._calls.answer_done()

    def _wake_up(self) -> None:
        """Answer what is due; called by another thread."""
        runner = self._runner  # None between two scenes: attaching the next one does the same
        if runner is not None:
            runner.post(self._calls.answer_due)

    def _stop_waits(self) -> bool:
        """Return whether a client's stop waits while a script does not return; for the watchdog's thread."""
        runner = self._runner
        try:
            if runner is not None and self._stops.look():
                runner.post(self._handle_ahead)
        except Exception as error:  # the watchdog goes on
            self._socket.report("a message of a remote client", error)
        return self._stops.found()

    def _handle_ahead(self) -> None:
        self._stops.forget()
        self._socket.serve_again()
