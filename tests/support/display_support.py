# SPDX-License-Identifier: BSD-3-Clause
"""A virtual display for a test."""

import os
import subprocess
from types import TracebackType

import numpy as np
import numpy.typing as npt
from PIL import ImageGrab

from ros_support import start, stop


class Display:
    """Xvfb on a free number; `env` has the variables for programs to use it."""

    def __init__(self, env: dict[str, str], size: str = "1280x900x24") -> None:
        read, write = os.pipe()
        # By default a server resets when its last client leaves, and refuses those that come meanwhile.
        command = ["Xvfb", "-displayfd", str(write), "-screen", "0", size, "-nolisten", "tcp", "-noreset"]
        self._process = start(command, env, pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as reported:
            number = reported.readline().strip()
        assert number, "Xvfb did not start"
        self.env = {**env, "DISPLAY": f":{number}", "LIBGL_ALWAYS_SOFTWARE": "1"}

    def xdotool(self, *arguments: object) -> str:
        """Simulate keyboard and mouse, or search windows."""
        return subprocess.run(
            ["xdotool", *map(str, arguments)], env=self.env, capture_output=True, text=True, check=True, timeout=60
        ).stdout

    def windows(self, name: str) -> list[str]:
        """Return the numbers of the windows whose name matches a regular expression."""
        found = subprocess.run(
            ["xdotool", "search", "--onlyvisible", "--name", name],
            env=self.env,
            capture_output=True,
            text=True,
            check=False,
            timeout=60,
        )
        return found.stdout.split()

    def screenshot(self) -> npt.NDArray[np.uint8]:
        """Return the screen content: rows x columns x red, green, blue."""
        return np.asarray(ImageGrab.grab(xdisplay=self.env["DISPLAY"]).convert("RGB"))

    def __enter__(self) -> "Display":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        stop(self._process)
