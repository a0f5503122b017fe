# SPDX-License-Identifier: BSD-3-Clause
"""The ROS master of a test."""

from __future__ import annotations

import socket
import time
from dataclasses import dataclass
from typing import Any

from bubblesim.program.ros_calls import FailedRosCallError, RosCallError, call
from bubblesim.running.processes import Programs, RunError

_CALLER = "/bubblesim_test"
_TIMEOUT = 30.0  # s


@dataclass(frozen=True)
class Master:
    """A running ROS master."""

    uri: str

    @property
    def environment(self) -> dict[str, str]:
        """Return the environment variables with which nodes connect to it."""
        return {"ROS_MASTER_URI": self.uri, "ROS_HOSTNAME": "localhost"}

    def find_service(self, name: str) -> tuple[str, int] | None:
        """Return host and port of a service; None if it is not advertised."""
        try:
            uri: str = self._call("lookupService", name)
        except FailedRosCallError:
            return None
        host, _, port = uri.removeprefix("rosrpc://").rpartition(":")
        return host, int(port)

    def set_parameter(self, name: str, value: Any) -> None:
        """Set a parameter, for nodes started from now on."""
        self._call("setParam", name, value)

    def _call(self, method: str, *arguments: Any) -> Any:
        return call(self.uri, _CALLER, method, *arguments)

    def answers(self) -> bool:
        """Return whether the master responds."""
        try:
            self._call("getPid")
        except RosCallError:
            return False
        return True


def start_master(programs: Programs) -> Master:
    """Start a master on a free port, on simulated time. It starts faster than roscore, which also runs rosout."""
    with socket.socket() as holder:
        # The master sets SO_REUSEADDR, too, and may have the port; the kernel gives it to no other process meanwhile.
        holder.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        holder.bind(("127.0.0.1", 0))
        port = holder.getsockname()[1]
        master = Master(f"http://localhost:{port}")
        programs.start("ROS master", "rosmaster", "--core", "-p", str(port), serves_others=True)
        deadline = time.monotonic() + _TIMEOUT
        while not master.answers():
            programs.check()
            if time.monotonic() > deadline:
                raise RunError(f"the ROS master at {master.uri} does not respond")
            time.sleep(0.01)
    master.set_parameter("/use_sim_time", True)
    return master
