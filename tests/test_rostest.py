# SPDX-License-Identifier: BSD-3-Clause
"""Runs each rostest file in tests/ as a separate item, with its own master."""

import os
import subprocess
from pathlib import Path

import pytest

from ros_support import REPOSITORY

FILES = sorted((REPOSITORY / "tests").rglob("*.test"))


@pytest.mark.parametrize("file", FILES, ids=lambda path: str(path.relative_to(REPOSITORY / "tests")))
def test_rostest(file: Path, tmp_path: Path) -> None:
    environment = os.environ | {"ROS_HOME": str(tmp_path), "ROS_HOSTNAME": "localhost"}
    run = subprocess.run(
        ["rostest", "--text", str(file)], env=environment, capture_output=True, text=True, check=False, timeout=300
    )
    if run.returncode != 0:
        pytest.fail(f"exit code {run.returncode}\n{run.stdout}{run.stderr}", pytrace=False)
