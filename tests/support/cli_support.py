# SPDX-License-Identifier: BSD-3-Clause
"""The program bubblesim, run by tests."""

import os
import subprocess
from collections.abc import Mapping
from pathlib import Path

from ros_support import DEADLINE, built


def bubblesim(
    *arguments: object, env: Mapping[str, str] | None = None, cwd: Path | None = None, **changes: str
) -> "subprocess.CompletedProcess[str]":
    """Run it to its end; `changes` are made to the environment."""
    command = [str(built("bubblesim")), *map(str, arguments)]
    environment = {**(os.environ if env is None else env), **changes}
    return subprocess.run(
        command, env=environment, cwd=cwd, capture_output=True, text=True, timeout=3 * DEADLINE, check=False
    )
