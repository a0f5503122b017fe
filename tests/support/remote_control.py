# SPDX-License-Identifier: BSD-3-Clause
"""A node at the other end of the simulation's topics, in its own process."""

import re
import subprocess
import sys
import xmlrpc.client
from collections.abc import Callable
from pathlib import Path
from types import TracebackType
from typing import Any

from node_support import NAME, Node
from ros_support import start, stop, stopped_on_failure, wait_until


def wait_until_sent(env: dict[str, str], *topics: str) -> None:
    """Return when the node has a subscriber of each topic: what it publishes from now on arrives there."""

    def are_sent() -> bool:
        master: Any
        node: Any
        with xmlrpc.client.ServerProxy(env["ROS_MASTER_URI"]) as master:
            address = master.lookupNode("/test", NAME)[2]
        with xmlrpc.client.ServerProxy(address) as node:
            connections = node.getBusInfo("/test")[2]
        return set(topics) <= {topic for _, _, direction, _, topic, *_ in connections if direction == "o"}

    wait_until(are_sent, f"{', '.join(topics)} to be sent")


class Remote:
    """Sends Start, Pause and Stop, and records received values; connected once it is constructed."""

    def __init__(self, env: dict[str, str], log: Path, *topics: str) -> None:
        """`topics` are topics with their types in std_msgs, such as /simulationTime=Float32."""
        self._log = log
        command = [sys.executable, "-u", str(Path(__file__).with_name("remote_control_node.py")), *topics]
        with log.open("w") as output:
            self._process = start(command, env, stdin=subprocess.PIPE, stdout=output)
        with stopped_on_failure(self._process):
            wait_until(lambda: "connected" in log.read_text(), "the remote control to be connected")

    def press(self, what: str) -> None:
        """Send `start`, `pause` or `stop`."""
        self.send(f"/{what}Simulation", value=True)

    def send(self, topic: str, *, value: bool, count: int = 1) -> None:
        assert self._process.stdin is not None
        self._process.stdin.write(f"{topic} {value} {count}\n")
        self._process.stdin.flush()

    def received(self, topic: str) -> list[str]:
        """Return the values received so far, as printed."""
        return re.findall(rf"^{topic} (\S+)\n", self._log.read_text(), re.MULTILINE)

    def __enter__(self) -> "Remote":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        assert self._process.stdin is not None
        self._process.stdin.close()  # ends its loop; it does not handle signals while it reads
        stop(self._process)


Run = Callable[..., tuple[Node, Remote]]
"""The fixture `run`: a script's code, options of the node, and `subscribe`, as for Remote."""
