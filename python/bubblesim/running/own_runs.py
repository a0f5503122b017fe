# SPDX-License-Identifier: BSD-3-Clause
"""The nodes of this user that run on this machine, by what the kernel knows of processes."""

from __future__ import annotations

import itertools
import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from bubblesim.program.addresses import master_uri, ports_of

_NODE = "sim"


@dataclass(frozen=True)
class OwnRun:
    """A node of this user."""

    process: int
    scene: str
    memory: float  # MB in RAM
    seconds: float  # since it started
    master: str  # "" without ROS 1
    domain: str  # of ROS 2; "" without
    window: int | None  # port of its window


def own_runs() -> list[OwnRun]:
    """Return the nodes, oldest first."""
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            if _is_node(folder):
                found.append(_run_of(folder))
        except (OSError, ValueError, IndexError):
            continue  # it has ended
    return sorted(found, key=lambda run: -run.seconds)


def _is_node(folder: Path) -> bool:
    if folder.stat().st_uid != os.getuid():
        return False
    program = (folder / "exe").readlink()
    return program.name == _NODE and program.parent.name == "bubblesim"


def _run_of(folder: Path) -> OwnRun:
    arguments = (folder / "cmdline").read_text(errors="replace").split("\0")[1:-1]
    variables = (folder / "environ").read_text(errors="replace").split("\0")
    environment = dict(entry.split("=", 1) for entry in variables if "=" in entry)
    versions = _versions(arguments)
    status = dict(line.split(":", 1) for line in (folder / "status").read_text().splitlines() if ":" in line)
    started = int((folder / "stat").read_text().rpartition(")")[2].split()[19]) / os.sysconf("SC_CLK_TCK")
    uptime = float(Path("/proc/uptime").read_text().split()[0])
    process = int(folder.name)
    return OwnRun(
        process,
        next((argument for argument in arguments if argument[:1] != "-" and ":=" not in argument), ""),
        float(status["VmRSS"].split()[0]) / 1000.0,
        uptime - started,
        master_uri(environment) if "1" in versions else "",
        environment.get("ROS_DOMAIN_ID", "0") if "2" in versions else "",
        next((port for child in _windows_of(process) for port in ports_of(child)), None),
    )


def _versions(arguments: list[str]) -> set[str]:
    """Return the versions of ROS that a node with these arguments uses."""
    if "--no-ros" in arguments:
        return set()
    given = [argument.partition("=")[2] for argument in arguments if argument.startswith("--ros=")]
    given += [value for name, value in itertools.pairwise(arguments) if name == "--ros"]
    return {"1", "2"} if given[-1:] == ["both"] else set(given[-1:] or ["1"])


def _windows_of(process: int) -> Iterator[int]:
    """Yield the servers of windows that a node has started."""
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            parent = int((folder / "stat").read_text().rpartition(")")[2].split()[1])
            if parent == process and b"--until-closed" in (folder / "cmdline").read_bytes():
                yield int(folder.name)
        except (OSError, ValueError, IndexError):
            continue
