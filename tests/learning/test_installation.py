# SPDX-License-Identifier: BSD-3-Clause
"""The commands on the page of learning that install Gymnasium work on a Debian as it is."""

import os
import re
import subprocess
from pathlib import Path

import pytest

from ros_support import REPOSITORY

PAGE = REPOSITORY / "docs" / "learning" / "README.md"


@pytest.mark.long
def test_gymnasium_is_installed_beside_debians_numpy(tmp_path: Path) -> None:
    block = re.search(r"^```console\n((?:\$ .*\n)+?)```", PAGE.read_text(), re.MULTILINE)
    assert block
    commands = [line.removeprefix("$ ") for line in block[1].splitlines()]
    program = 'python -c "import numpy, gymnasium, bubblesim.gym_tasks, matplotlib; print(numpy.__file__)"'
    path = os.environ["PATH"].removeprefix(f"{os.environ.get('VIRTUAL_ENV', '')}/bin:")
    run = subprocess.run(
        ["bash", "-euc", "\n".join([*commands, program])],
        env={**os.environ, "HOME": str(tmp_path), "PATH": path},
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    assert run.stdout.splitlines()[-1].startswith("/usr/lib/python3/dist-packages/numpy/")
