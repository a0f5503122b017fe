# SPDX-License-Identifier: BSD-3-Clause
"""The program gzclient: opens the window of the simulation that runs."""

from __future__ import annotations

import os
import signal
import sys
import time
import webbrowser
from pathlib import Path

from bubblesim.web.address_file import newest_address_file

_TIMEOUT = 30.0  # s
_PERIOD = 0.2  # s


def main() -> int:
    """Open the window in a browser, if there is a display; end with SIGINT or SIGTERM."""
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: sys.exit(0))
    file = _wait_for_window()
    if file is None:
        print("error: no simulation shows its window: start it with gui:=true or gzserver --web", file=sys.stderr)
        return 1
    if os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"):
        webbrowser.open(file.as_uri())  # a command line with the address itself would show its token
    else:
        print(f"info: no display: open {file} in a browser of this machine", flush=True)
    while file.exists():
        time.sleep(1.0)
    return 0


def _wait_for_window() -> Path | None:
    until = time.monotonic() + _TIMEOUT
    while time.monotonic() < until:
        if (file := newest_address_file()) is not None:
            return file
        time.sleep(_PERIOD)
    return None
