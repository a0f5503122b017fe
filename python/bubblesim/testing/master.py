# SPDX-License-Identifier: BSD-3-Clause
"""A ROS master of a test's own."""

from __future__ import annotations

import socket
import time
import xmlrpc.client
from dataclasses import dataclass
from typing import Any

from bubblesim.running.processes import Programs, RunError

_CALLER = "/bubblesim_test"
_PATIENCE = 30.0  # s


@dataclass(frozen=True)
class Master:
    """Where it is, and what it knows."""

    uri: str

    @property
    def environment(self) -> dict[str, str]:
        """What a process needs to find it."""
        return {"ROS_MASTER_URI": self.uri, "ROS_HOSTNAME": "localhost"}

    def find_service(self, name: str) -> tuple[str, int] | None:
        """Host and port of a service; None when nobody offers it."""
        code, _, uri = self._ask("lookupService", name)
        if code != 1:
            return None
        host, _, port = uri.removeprefix("rosrpc://").rpartition(":")
        return host, int(port)

    def set_parameter(self, name: str, value: Any) -> None:
        """Set a parameter, which nodes see that start from now on."""
        self._ask("setParam", name, value)

    def _ask(self, method: str, *arguments: Any) -> Any:
        return getattr(xmlrpc.client.ServerProxy(self.uri), method)(_CALLER, *arguments)

    def answers(self) -> bool:
        """Whether it is there yet."""
        try:
            return bool(self._ask("getPid")[0] == 1)
        except (OSError, xmlrpc.client.Error):
            return False


def start_master(programs: Programs) -> Master:
    """Start one on a free port, on simulated time. Without the log that roscore keeps besides, it is there at once."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    master = Master(f"http://localhost:{port}")
    programs.start("ROS master", "rosmaster", "--core", "-p", str(port), serves_others=True)
    deadline = time.monotonic() + _PATIENCE
    while not master.answers():
        programs.check()
        if time.monotonic() > deadline:
            raise RunError(f"the ROS master at {master.uri} does not answer")
        time.sleep(0.01)
    master.set_parameter("/use_sim_time", True)
    return master
