# SPDX-License-Identifier: BSD-3-Clause
"""The frames that a node publishes, as a client reads them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import cbor2
import numpy as np
import numpy.typing as npt
import zmq

from bubblesim.remote.frame_publisher import request_of

Floats = npt.NDArray[np.float32]


@dataclass(frozen=True)
class Frame:
    """What the simulation looked like at one time."""

    time: float
    """Simulation time in s."""
    state: str
    """stopped, paused, running, or stopping in the last step."""
    links: list[str]
    """Paths of the links of ``poses``: those of models that are not static."""
    poses: Floats
    """n x 7: x, y, z in m and the quaternion x, y, z, w of each link in the world."""
    joints: list[tuple[str, int]]
    """Path and axis of each of ``joint_positions``."""
    joint_positions: Floats
    """rad or m."""


def read_frames(
    open_socket: Callable[[], zmq.Socket[bytes]], host: str, timeout: float, call: Callable[..., Any]
) -> Iterator[Frame]:
    """Yield the last frame again and again, each one once; see Connection.frames."""
    socket = open_socket()
    try:
        port, secret = call("frames.open")
        socket.connect(f"tcp://{host}:{port}")
        known = None
        number = 0
        links: list[str] = []
        joints: list[tuple[str, int]] = []
        while True:
            socket.send(request_of(secret, number))
            if not socket.poll(int(1000 * timeout)):
                raise TimeoutError(f"no frame from {host} in {timeout:g} s")
            message = cbor2.loads(socket.recv())
            if message["number"] == number:  # sent again as a sign of life
                continue
            number = message["number"]
            shown = (message["scene"], message["revision"])
            if shown != known:
                layout = call("frames.layout")
                known, links = (layout["scene"], layout["revision"]), layout["links"]
                joints = [(path, axis) for path, axis in layout["joints"]]
            if shown != known:
                continue  # of the objects before
            poses = np.frombuffer(message["poses"], np.float32).reshape(-1, 7)
            positions = np.frombuffer(message["joint_positions"], np.float32)
            yield Frame(message["time"], message["state"], links, poses, joints, positions)
    finally:
        socket.close()
