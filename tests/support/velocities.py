# SPDX-License-Identifier: BSD-3-Clause
"""Commands of a node on cmd_vel, recorded with `rostopic echo`."""

from pathlib import Path

from ros_support import RosCore, start, stop


class Velocities:
    """Subscribes from its construction on."""

    def __init__(self, core: RosCore, file: Path) -> None:
        self._file = file
        with file.open("w") as output:
            self._listener = start(["rostopic", "echo", "-p", "/cmd_vel"], core.env, stdout=output)

    def all(self) -> list[tuple[float, float]]:
        """Return forward and turning velocity of each command so far."""
        lines = self._file.read_text().rpartition("\n")[0].splitlines()  # the last one may not be complete
        rows = [line.split(",") for line in lines[1:] if line.count(",") == lines[0].count(",")]
        return [(float(row[1]), float(row[6])) for row in rows]

    def last(self) -> tuple[float, float] | None:
        """Return forward and turning velocity of the last command, None before the first."""
        return (self.all() or [None])[-1]

    def close(self) -> None:
        stop(self._listener)
