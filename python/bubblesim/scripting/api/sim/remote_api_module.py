# SPDX-License-Identifier: BSD-3-Clause
"""The module `simRemoteApi` of one child script."""

from __future__ import annotations

import sys

from bubblesim.program.output import write_line
from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.functions import script_module
from bubblesim.scripting.caller import Caller

_NOT_SERVED = "it serves the legacy remote API; here programs use the ZeroMQ client"


@script_module("simRemoteApi")
class SimRemoteApi:
    """The legacy remote API (`simx...`) is not served: programs connect with the ZeroMQ client, see --remote."""

    def __init__(self, caller: Caller) -> None:
        """Bind the functions to one script."""
        self._caller = caller

    @differs(_NOT_SERVED)
    def start(self, port: int, size: int = 1300, debug: bool = False, trigger: bool = False) -> int:
        """Return -1, with a warning: the legacy remote API is not served."""
        write_line(
            sys.stderr,
            f"warning: {self._caller.object_path}: simRemoteApi.start: the legacy remote API (simx...) is not served: "
            "start the node with --remote, and use coppeliasim-zmqremoteapi-client",
        )
        return -1

    @differs(_NOT_SERVED)
    def stop(self, port: int) -> int:
        """Return -1: nothing was started."""
        return -1

    @differs(_NOT_SERVED)
    def reset(self, port: int) -> int:
        """Return -1: nothing was started."""
        return -1

    @differs(_NOT_SERVED)
    def status(self, port: int) -> tuple[int, list[int], int, str]:
        """Return -1: nothing was started."""
        return -1, [], 0, ""
