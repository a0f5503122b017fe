# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that start programs and list the simulator's modules."""

from __future__ import annotations

import shlex
import subprocess

from bubblesim.scripting.allowed_programs import find_program, refused_argument
from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.sim.logs import LogFunctions

_MOST_RUNNING = 64  # programs of one caller


class ProgramFunctions(LogFunctions):
    """Programs started by a script end with it, together with their child processes."""

    @differs("it starts any program; here Lua scripts and remote clients start those that are allowed")
    def launchExecutable(self, file: str, arguments: str = "", show_status: int = 1) -> int:
        """Start a program of this package or on PATH; ``arguments`` is split as in a shell.

        Returns its process id; -1, with a warning, if there is no such program. A Lua script or a remote client can
        start the programs that the package.xml of their ROS package lists, and those given by the node's option
        --allow-programs; for others it raises a PermissionError.
        """
        caller = self._caller
        words = shlex.split(arguments)
        try:
            program = find_program(file)
        except FileNotFoundError as error:
            self.addLog(self.verbosity_scriptwarnings, f"sim.launchExecutable: {error}")
            return -1
        if not caller.may_start(program):
            raise PermissionError(
                f"{caller.object_path} must not start {program}, which no ROS package lists for scripts; allow it with "
                f"the node's option --allow-programs {program}, or in the package.xml of its package: "
                f'<export><bubblesim programs="{program.name}"/></export>'
            )
        if not caller.may_use_files and (refused := refused_argument(words)):
            raise PermissionError(f"{caller.object_path} must not pass {refused}: it can write files or open ports")
        if sum(each.poll() is None for each in caller.programs) >= _MOST_RUNNING:
            raise RuntimeError(f"{caller.object_path} already runs {_MOST_RUNNING} programs, the most for one script")
        process = subprocess.Popen([str(program), *words], process_group=0)
        caller.programs.append(process)
        return process.pid

    def getModuleName(self, index: int) -> str | None:
        """Return the name of a plugin, 'RosInterface' for the ROS bridge; None (nil) if the index is too large."""
        plugins = ["RosInterface"] if self._caller.shared.has_ros else []
        return plugins[index] if 0 <= index < len(plugins) else None
