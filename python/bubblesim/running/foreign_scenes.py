# SPDX-License-Identifier: BSD-3-Clause
"""Runs the reader of CoppeliaSim's files."""

from __future__ import annotations

import subprocess
from pathlib import Path

from bubblesim.running.places import scene_converter


def read_foreign(command: str, file: Path, *more: Path) -> str:
    """Return what the reader prints for "describe" or "convert"; raise ValueError for a file that cannot be read."""
    run = subprocess.run([scene_converter(), command, file, *more], capture_output=True, check=False)
    if run.returncode != 0:
        raise ValueError(f"{file}: {run.stderr.decode(errors='replace').strip() or 'the file is damaged'}")
    return run.stdout.decode(errors="replace")
