# SPDX-License-Identifier: BSD-3-Clause
"""A process that carries out runs: `python -m bubblesim.sweeps.worker DESCRIPTOR`.

Over the socket it gets the program and answers None, or the text of an error; then it gets tasks and answers outcomes.
"""

from __future__ import annotations

import ctypes
import os
import signal
import sys
from multiprocessing.connection import Connection

_PR_SET_PDEATHSIG = 1  # of <sys/prctl.h>


def main() -> int:
    """Serve one driver until it closes the socket."""
    driver = os.getppid()
    ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)  # also in the middle of a run
    if os.getppid() != driver:
        return 1
    os.dup2(2, 1)  # the driver prints data on stdout
    connection: Connection = Connection(int(sys.argv[1]))
    try:
        _serve(connection)
    except EOFError:
        return 0
    return 0


def _serve(connection: Connection) -> None:
    from bubblesim.sweeps.programs import execute

    program = connection.recv()
    try:
        function = program.load()
    except (ValueError, LookupError) as error:  # SweepError, SceneError, NoSuchObject
        connection.send(str(error))
        return
    connection.send(None)
    while True:
        connection.send(execute(function, program, connection.recv()))


if __name__ == "__main__":
    sys.exit(main())
