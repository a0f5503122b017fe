# SPDX-License-Identifier: BSD-3-Clause
"""Publishes frames, the poses of all moving links, for programs on any machine.

A thread of its own reads the runner's last frame, which needs no lock. A reader that is slow loses frames, and cannot
hold up a step.
"""

from __future__ import annotations

import threading
import time
from typing import Any

import zmq

from bubblesim.remote import protocol
from bubblesim.remote.remote_client import RemoteClient

_PERIOD = 1 / 60  # s of wall time between two looks at the frame
_IDLE = 0.25  # s, without readers
_REPEAT = 1.0  # s after which a frame is sent again: for new readers, and as a sign of life
_MOST_WAITING = 2  # frames for one reader
_MOST_BYTES = 256  # of what a reader may send
_MOST_AT_ONCE = 1000  # messages of readers between two frames


class FramePublisher:
    """Publishes the frames of the scene that runs, while somebody reads them."""

    def __init__(self, context: zmq.Context[Any], host: str) -> None:
        """Bind a free port of an address, such as "127.0.0.1"."""
        self._scene: tuple[int, Any] | None = None
        self._socket = context.socket(zmq.XPUB)
        self._socket.setsockopt(zmq.SNDHWM, _MOST_WAITING)
        self._socket.setsockopt(zmq.LINGER, 0)
        self._socket.setsockopt(zmq.MAXMSGSIZE, _MOST_BYTES)
        self.port: int = self._socket.bind_to_random_port(f"tcp://{host}")
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
        has_readers = False
        last: Any = None
        sent = 0.0
        while not self._ending.is_set():
            if self._socket.poll(0 if has_readers else int(1000 * _IDLE)):
                has_readers = self._read_subscriptions(has_readers)
                last = None
            if not has_readers:
                continue
            if (now := self._last_frame()) is not None and (now != last or time.monotonic() - sent > _REPEAT):
                self._socket.send(_message(*now))  # never waits: what a reader cannot take is dropped
                last, sent = now, time.monotonic()
            self._ending.wait(_PERIOD)

    def _read_subscriptions(self, has_readers: bool) -> bool:
        """Return whether there are readers now: XPUB reports the first and the last one, and what peers send else."""
        for _ in range(_MOST_AT_ONCE):
            if not self._socket.poll(0):
                break
            message = self._socket.recv()
            if message in (b"\0", b"\1"):
                has_readers = message == b"\1"
        return has_readers

    def _last_frame(self) -> tuple[int, Any] | None:
        scene = self._scene
        return scene and (scene[0], scene[1].frame)


def layout(client: RemoteClient) -> dict[str, Any]:
    """Return what the numbers of the frames belong to: paths of links, and paths and axes of joints."""
    runner = client.door.host.runner
    frame, path = runner.frame, runner.simulation.world.path
    return {
        "scene": client.door.scenes,
        "revision": frame.revision,
        "links": [path(link) for link in frame.links],
        "joints": [[path(joint), axis] for joint, axis in frame.axes],
    }


def _message(scene: int, frame: Any) -> bytes:
    return protocol.encode(
        {
            "scene": scene,
            "time": frame.time,
            "state": frame.state.name.lower(),
            "revision": frame.revision,
            "poses": frame.poses.tobytes(),
            "joint_positions": frame.joint_positions.tobytes(),
        }
    )
