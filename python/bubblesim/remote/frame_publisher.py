# SPDX-License-Identifier: BSD-3-Clause
"""Publishes frames, the poses of all moving links, for programs on any machine.

A thread of its own reads the runner's last frame, which needs no lock. Readers ask for each frame and name the last one
that they have: a slow reader skips frames, holds up no step, and none wait for it here. They prove by a secret that
the remote API has let them in.
"""

from __future__ import annotations

import secrets
import threading
import time
from typing import Any

import zmq

from bubblesim.remote import protocol
from bubblesim.remote.remote_client import RemoteClient

_PERIOD = 1 / 60  # s of wall time between two polls of the frame
_IDLE = 250  # ms between two polls of the end, without readers
_REPEAT = 1.0  # s after which a frame is sent again, as a sign of life
_MOST_WAITING = 2  # requests or frames for one reader
_MOST_READERS = 1000
_MOST_BYTES = 256  # of what a reader may send, also when it connects
_MOST_AT_ONCE = 1000  # messages of readers between two frames
_SECRET_BYTES = 24
_NUMBER_BYTES = 8


class FramePublisher:
    """Publishes the frames of the scene that runs, while somebody reads them.

    A request is the secret and, in 8 bytes, big-endian, the number of the last frame that the reader has; 0 for none.
    """

    def __init__(self, context: zmq.Context[Any], host: str) -> None:
        """Bind a free port of an address, such as "127.0.0.1"."""
        self._scene: tuple[int, Any] | None = None
        self.secret = secrets.token_bytes(_SECRET_BYTES)
        self._socket = context.socket(zmq.ROUTER)
        self._socket.setsockopt(zmq.SNDHWM, _MOST_WAITING)
        self._socket.setsockopt(zmq.RCVHWM, _MOST_WAITING)
        self._socket.setsockopt(zmq.LINGER, 0)
        self._socket.setsockopt(zmq.MAXMSGSIZE, _MOST_BYTES)
        self.port: int = self._socket.bind_to_random_port(f"tcp://{host}")
        self._waiting: dict[bytes, tuple[int, float]] = {}  # last frame and time of the request, by identity
        self._ending = threading.Event()
        self._thread = threading.Thread(target=self._run, name="frames", daemon=True)
        self._thread.start()

    def show(self, scene: int, runner: Any) -> None:
        """Publish the frames of another scene.

        :param scene: its number, so that readers know that it is another.
        """
        self._scene = (scene, runner)

    def show_none(self) -> None:
        """Wait for the next scene."""
        self._scene = None

    def close(self) -> None:
        """Stop publishing."""
        self._ending.set()
        self._thread.join()
        self._socket.close()

    def _run(self) -> None:
        last: Any = None
        number = 0
        while not self._ending.is_set():
            if self._socket.poll(0 if self._waiting else _IDLE):
                self._read_requests()
            if not self._waiting:
                continue
            if (now := self._last_frame()) is not None:
                if now != last:
                    last, number = now, number + 1
                self._answer(number, now)
            self._ending.wait(_PERIOD)

    def _read_requests(self) -> None:
        for _ in range(_MOST_AT_ONCE):
            if not self._socket.poll(0):
                return
            identity, *parts = self._socket.recv_multipart()
            request = parts[-1] if len(parts) == 2 else b""
            if secrets.compare_digest(request[:_SECRET_BYTES], self.secret) and len(self._waiting) < _MOST_READERS:
                self._waiting[identity] = (int.from_bytes(request[_SECRET_BYTES:]), time.monotonic())

    def _answer(self, number: int, frame: tuple[int, Any]) -> None:
        """Send a frame to those that have another, or that have waited for long."""
        message = b""
        now = time.monotonic()
        for identity, (known, since) in list(self._waiting.items()):
            if known != number or now - since > _REPEAT:
                del self._waiting[identity]
                message = message or _message(number, *frame)
                self._socket.send_multipart([identity, b"", message])  # never waits: a reader that is gone gets nothing

    def _last_frame(self) -> tuple[int, Any] | None:
        scene = self._scene
        return scene and (scene[0], scene[1].frame)


def request_of(secret: bytes, number: int) -> bytes:
    """Return what a reader sends that has the frame of this number; 0 for none."""
    return secret + number.to_bytes(_NUMBER_BYTES)


def layout(client: RemoteClient) -> dict[str, Any]:
    """Return what the numbers of the frames belong to: paths of links, and paths and axes of joints."""
    runner = client.server.host.runner
    frame, path = runner.frame, runner.simulation.world.path
    return {
        "scene": client.server.scenes,
        "revision": frame.revision,
        "links": [path(link) for link in frame.links],
        "joints": [[path(joint), axis] for joint, axis in frame.axes],
    }


def _message(number: int, scene: int, frame: Any) -> bytes:
    return protocol.encode(
        {
            "number": number,
            "scene": scene,
            "time": frame.time,
            "state": frame.state.name.lower(),
            "revision": frame.revision,
            "poses": frame.poses.tobytes(),
            "joint_positions": frame.joint_positions.tobytes(),
        }
    )
