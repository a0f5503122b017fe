# SPDX-License-Identifier: BSD-3-Clause
"""A client for Python programs: ``bubblesim.connect``."""

from __future__ import annotations

import functools
import logging
import uuid
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Self
from weakref import WeakSet

import cbor2
import numpy as np
import zmq

from bubblesim.remote.frames import Frame, read_frames
from bubblesim.remote.remote_sim import RemoteSim
from bubblesim.remote.token import read
from bubblesim.scripting.api.functions import functions

_PORT = 23000
_SILENT_TIME = 2000  # ms without an answer until the program is told what it waits for
_LOG = logging.getLogger(__name__)


class Connection:
    """A running simulator, driven from another process.

    ``sim`` has the functions and constants of `sim` with their documentation. Lists of numbers arrive as numpy arrays.
    """

    def __init__(
        self, port: int = _PORT, host: str = "127.0.0.1", *, timeout: float = 60.0, token: Path | str | None = None
    ) -> None:
        """Connect to a node that was started with --remote.

        :param timeout: s to wait for a reply, more than the longest ``sim.wait``.
        :param token: file with the token of a node that was started with --remote-token.
        :raises TimeoutError: if there is no answer.
        :raises RuntimeError: if the node wants another token.
        """
        self._secret = {"token": read(Path(token))} if token is not None else {}
        self._host = host
        self._address = f"{host}:{port}"
        self._uuid = str(uuid.uuid4())
        self._timeout = timeout
        self._sockets: WeakSet[zmq.Socket[bytes]] = WeakSet()
        self._socket = self._open_socket()
        self._socket.connect(f"tcp://{self._address}")
        try:
            self._send("zmqRemoteApi.info", ["sim"])
            if 1000 * timeout > _SILENT_TIME and not self._socket.poll(_SILENT_TIME):
                text = "no answer from %s yet, waiting up to %g s: start a simulator with --remote=%d"
                _LOG.warning(text, self._address, timeout, port)
            known = self._reply("zmqRemoteApi.info")
        except TimeoutError:
            self.close()
            raise TimeoutError(
                f"no answer from {self._address} in {timeout:g} s: is there a simulator? start it with --remote={port}"
            ) from None
        except RuntimeError:
            self.close()
            raise
        self.sim: Any = SimpleNamespace(**{name: e["const"] for name, e in known.items() if "const" in e})
        for function in functions(RemoteSim):
            if function.name in known:
                setattr(self.sim, function.name, self._function(function.name))

    def call(self, function: str, *arguments: Any) -> Any:
        """Call a function by its full name, such as 'sim.getObject'; raise RuntimeError with its error."""
        plain = [value.tolist() if isinstance(value, np.ndarray | np.generic) else value for value in arguments]
        self._send(function, plain)
        return self._reply(function)

    def frames(self) -> Iterator[Frame]:
        """Yield the last frame of the simulation again and again, as it changes, up to 60 a second.

        Between two frames it waits. A program that is slow skips frames and does not slow the simulation.

        >>> for frame in simulator.frames():
        ...     print(frame.time, frame.poses[frame.links.index("/Ball/body")])

        :raises TimeoutError: if the node is gone.
        """
        return read_frames(self._open_socket, self._host, self._timeout, self.call)

    def close(self) -> None:
        """Disconnect, which ends the stepping mode of this connection."""
        for socket in self._sockets:  # with those of frames
            socket.close()

    def __enter__(self) -> Self:
        """Return this connection."""
        return self

    def __exit__(self, *_error: object) -> None:
        """Disconnect."""
        self.close()

    def _open_socket(self) -> zmq.Socket[bytes]:
        """Return a socket of the program's context: that of a connection alone would, collected as garbage before its
        sockets, wait for ever until they are closed."""
        socket: zmq.Socket[bytes] = zmq.Context.instance().socket(zmq.REQ)
        socket.setsockopt(zmq.LINGER, 0)
        self._sockets.add(socket)
        return socket

    def _send(self, function: str, arguments: list[Any]) -> None:
        self._socket.send(cbor2.dumps({"func": function, "args": arguments, "uuid": self._uuid, **self._secret}))

    def _reply(self, function: str) -> Any:
        if not self._socket.poll(int(1000 * self._timeout)):
            raise TimeoutError(f"no answer from {self._address} to {function} in {self._timeout:g} s")
        reply = cbor2.loads(self._socket.recv())
        if "err" in reply:
            raise RuntimeError(reply["err"])
        results = [_typed(value) for value in reply["ret"]]
        return results[0] if len(results) == 1 else tuple(results) if results else None

    def _function(self, name: str) -> Any:
        @functools.wraps(getattr(RemoteSim, name))
        def call(*arguments: Any) -> Any:
            return self.call(f"sim.{name}", *arguments)

        return call


def _typed(value: Any) -> Any:
    """Return a list of numbers as an array."""
    if isinstance(value, list) and value and all(isinstance(each, float) for each in value):
        return np.array(value)
    return value


def connect(
    port: int = _PORT, host: str = "127.0.0.1", *, timeout: float = 60.0, token: Path | str | None = None
) -> Connection:
    """Connect to a node that was started with --remote; see Connection.

    >>> with bubblesim.connect() as simulator:
    ...     simulator.sim.startSimulation()
    """
    return Connection(port, host, timeout=timeout, token=token)
