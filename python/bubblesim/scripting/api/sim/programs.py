# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that start programs and list the simulator's modules."""

from __future__ import annotations

import shlex
import subprocess

from bubblesim.scripting.allowed_programs import find_program
from bubblesim.scripting.api.sim.context import ApiContext


class ProgramFunctions(ApiContext):
    """Programs started by a script end with it, together with their child processes."""

    def launchExecutable(self, file: str, arguments: str = "", show_status: int = 1) -> int:
        """Start a program of this package or on PATH; ``arguments`` is split as in a shell.

        Returns its process id. A Lua script can start programs of ROS packages, and those given by the node's option
        --allow-programs; for others it raises a PermissionError.
        """
        program = find_program(file)
        if not self._caller.may_start(program):
            raise PermissionError(
                f"a Lua script must not start {program}, which is not part of a ROS package of the workspace; "
                f"allow it with the node's option --allow-programs {program}"
            )
        process = subprocess.Popen([str(program), *shlex.split(arguments)], process_group=0)
        self._caller.programs.append(process)
        return process.pid

    def getModuleName(self, index: int) -> str | None:
        """Return the name of a plugin, 'RosInterface' for the ROS bridge; None (nil) if the index is too large."""
        plugins = ["RosInterface"] if self._caller.shared.has_ros else []
        return plugins[index] if 0 <= index < len(plugins) else None
