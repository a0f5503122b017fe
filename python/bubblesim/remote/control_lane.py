# SPDX-License-Identifier: BSD-3-Clause
"""Stops and pauses a simulation whose thread does not serve the remote API: a script that does not return keeps it.

A thread of its own owns a second socket, beside that of the remote API in the folder that only this user may enter. It
hands over commands, which the runner carries out between steps; a script that is stuck is interrupted for a pending
stop.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

import zmq

from bubblesim.remote import protocol

_PERIOD = 250  # ms between two checks for the end
COMMANDS: dict[str, Callable[[Any], object]] = {
    "window.stop": lambda runner: runner.stop(wait=False),
    "window.pause": lambda runner: runner.pause(wait=False),
}
"""By the names that the functions of the window have in the remote API."""


def path_of(path: str) -> str:
    """Return the path of the lane's socket beside that of the remote API, at ``path``."""
    return f"{path}-control"


class ControlLane:
    """Hands commands to the runner of the scene that runs."""

    def __init__(self, context: zmq.Context[Any], path: str) -> None:
        """Listen beside the Unix domain socket at ``path``."""
        self._runner: Any = None
        self._guard = threading.Lock()  # of the runner, which must not end while a command is handed over
        self._ending = threading.Event()
        self._socket = context.socket(zmq.REP)
        try:
            self._socket.setsockopt(zmq.LINGER, 0)
            self._socket.setsockopt(zmq.MAXMSGSIZE, 1 << 16)
            self._socket.bind(f"ipc://{path_of(path)}")
            self._thread = threading.Thread(target=self._run, name="control lane", daemon=True)
            self._thread.start()
        except BaseException:
            self._socket.close(0)
            raise

    def show(self, runner: Any) -> None:
        """Command this runner from now on; None between two scenes."""
        with self._guard:
            self._runner = runner

    def close(self) -> None:
        """Stop listening."""
        self._ending.set()
        self._thread.join()
        self._socket.close()

    def _run(self) -> None:
        while not self._ending.is_set():
            if self._socket.poll(_PERIOD):
                self._socket.send(self._answer(self._socket.recv()))

    def _answer(self, message: bytes) -> bytes:
        try:
            function = protocol.decode(message).function
            command = COMMANDS.get(function)
            if command is None:
                raise AttributeError(f"there is no command '{function}' here: {', '.join(COMMANDS)}")
            with self._guard:
                if self._runner is None:
                    raise RuntimeError("another scene is being loaded")
                command(self._runner)
        except Exception as error:
            return protocol.error_of(error)
        return protocol.result(None)
