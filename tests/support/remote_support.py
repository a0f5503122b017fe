# SPDX-License-Identifier: BSD-3-Clause
"""A node that serves remote clients, and such clients."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import zmq
from coppeliasim_zmqremoteapi_client import RemoteAPIClient

from node_support import Node
from ros_support import DEADLINE, free_port, ros_environment, stopped_on_failure

TIMEOUT = int(1000 * DEADLINE)  # ms for a reply


class RemoteNode(Node):
    """A node that serves remote clients, and its port."""

    def __init__(
        self, folder: Path, *options: object, scene: str = "tricycle", environment: dict[str, str] | None = None
    ) -> None:
        """Start it, with ROS if there is an environment of a roscore."""
        self.port = free_port()
        log = folder / f"node_{self.port}.txt"
        ros = [] if environment else ["--no-ros"]
        environment = environment or ros_environment(free_port(), folder)
        super().__init__(environment, log, scene, *ros, f"--remote={self.port}", *options)
        with stopped_on_failure(self.process):
            self.wait_for_output("remote clients can connect")

    def client(self) -> RemoteAPIClient:
        client = RemoteAPIClient(port=self.port)
        client.socket.setsockopt(zmq.RCVTIMEO, TIMEOUT)
        client.socket.setsockopt(zmq.LINGER, 0)
        return client

    def sim(self) -> Any:
        client = self.client()
        sim = client.require("sim")
        sim.client = client  # keeps the socket open
        return sim

    def raw(self, kind: int = zmq.REQ) -> "zmq.Socket[bytes]":
        socket = zmq.Context.instance().socket(kind)
        socket.setsockopt(zmq.RCVTIMEO, TIMEOUT)
        socket.setsockopt(zmq.LINGER, 0)
        socket.connect(f"tcp://127.0.0.1:{self.port}")
        return socket


def refusal(call: Callable[..., object], *arguments: object) -> str:
    """Return the error of a call."""
    with pytest.raises(Exception) as raised:  # noqa: PT011  # the client raises no other type
        call(*arguments)
    return str(raised.value)


def warning(sim: Any, call: Callable[..., object], *arguments: object) -> str:
    """Return the warning of a call that physics refuses, after which a program of CoppeliaSim goes on."""
    last = sim.getLog()["last"]
    call(*arguments)
    return str(sim.getLog(last)["entries"][0]["text"])
