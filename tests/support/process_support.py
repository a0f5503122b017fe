# SPDX-License-Identifier: BSD-3-Clause
"""What the kernel knows of a process."""

import contextlib
import os
from pathlib import Path


def open_files(pid: int) -> int:
    """Return how many descriptors are open."""
    return len(list(Path(f"/proc/{pid}/fd").iterdir()))


def status(pid: int, name: str) -> int:
    """Return a number of its status, such as VmRSS (KiB) or Threads."""
    lines = Path(f"/proc/{pid}/status").read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith(f"{name}:"))


def cpu_seconds(pid: int) -> float:
    """Return the processor time of all its threads so far."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def listening_ports(pid: int) -> list[int]:
    """Return the TCP ports on which a process listens."""
    own = set()
    for each in Path(f"/proc/{pid}/fd").iterdir():
        with contextlib.suppress(FileNotFoundError):  # closed meanwhile
            own.add(str(each.readlink()))
    tables = (Path(f"/proc/{pid}/net/{name}").read_text().splitlines()[1:] for name in ("tcp", "tcp6"))
    sockets = [row for table in tables for line in table if (row := line.split())[3] == "0A"]  # LISTEN
    return [int(row[1].rpartition(":")[2], 16) for row in sockets if f"socket:[{row[9]}]" in own]
