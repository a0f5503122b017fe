# SPDX-License-Identifier: BSD-3-Clause
"""The benchmarks, which the default build does not include, compile."""

import os
import re
import subprocess
from pathlib import Path

from ros_support import REPOSITORY, built

PROGRAM = re.compile(r"^\s*add_executable\((\w+)", re.MULTILINE)


def test_all_benchmarks_compile() -> None:
    build = Path(os.environ.get("BUBBLESIM_BUILD_DIR", REPOSITORY / ".ws" / "build" / "bubblesim"))
    run = subprocess.run(
        ["cmake", "--build", build, "--target", "benchmarks"], capture_output=True, text=True, check=False
    )
    assert run.returncode == 0, run.stdout + run.stderr
    lists = (REPOSITORY / "benchmarks").glob("*/CMakeLists.txt")
    programs = [name for file in lists for name in PROGRAM.findall(file.read_text())]
    assert len(programs) >= 6
    assert all(built(name) for name in programs)
