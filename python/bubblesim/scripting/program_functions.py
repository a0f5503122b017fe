# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that start programs, write messages and name the simulator's parts."""

from __future__ import annotations

import shlex
import shutil
import subprocess
import sys
from pathlib import Path

from bubblesim.scripting.context import ApiContext
from bubblesim.scripting.output import write_line


class ProgramFunctions(ApiContext):
    """Programs started by a script end with it, and so does what they have started."""

    def launchExecutable(self, file: str, arguments: str = "", show_status: int = 1) -> int:
        """Start a program of this package or on PATH; ``arguments`` is split as a shell would.

        Returns its process id.
        """
        program = _find_program(file)
        process = subprocess.Popen([str(program), *shlex.split(arguments)], process_group=0)
        self._script.programs.append(process)
        return process.pid

    def getModuleName(self, index: int) -> str | None:
        """Name of a plugin, 'RosInterface' for the bridge to ROS; None (nil) when there are not so many."""
        plugins = ["RosInterface"] if self._script.host.bridge is not None else []
        return plugins[index] if 0 <= index < len(plugins) else None

    def addLog(self, level: object, text: object) -> None:
        """Write a message; errors and warnings go to stderr, what is more detailed than infos is left out."""
        if isinstance(level, int) and level > self.verbosity_infos:
            return
        errors = (self.verbosity_errors, self.verbosity_scripterrors)
        warnings = (self.verbosity_warnings, self.verbosity_scriptwarnings)
        kind = "error" if level in errors else "warning" if level in warnings else "info"
        stream = sys.stdout if kind == "info" else sys.stderr
        try:
            shown = str(text)
        except Exception:
            shown = object.__repr__(text)
        write_line(stream, f"{kind}: {self._script.object_path}: {shown}")

    def addStatusbarMessage(self, text: object) -> None:
        """Write a message."""
        self.addLog(self.verbosity_scriptinfos, text)


def _find_program(file: str) -> Path:
    # In a development or an install space, beside the simulator's own program; from Python, in the source tree.
    folders = [Path("/proc/self/exe").resolve().parent, Path(__file__).resolve().parents[3] / "scripts"]
    for folder in folders:
        if (folder / file).is_file():
            return folder / file
    on_path = shutil.which(file)
    if on_path is None:
        raise FileNotFoundError(
            f"there is no program '{file}' in {' or '.join(map(str, folders))} or on PATH; "
            "give the name of an installed program or an absolute path"
        )
    return Path(on_path)
