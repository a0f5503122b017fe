# SPDX-License-Identifier: BSD-3-Clause
"""Public files of CoppeliaSim, if there are any beside the project."""

from pathlib import Path

import numpy as np
import pytest

from ros_support import REPOSITORY

_FOLDERS = [folder / "shared" / "ttt" for folder in (REPOSITORY.parent, REPOSITORY.parent.parent)]
FILES = sorted(
    {file for folder in _FOLDERS for suffix in ("ttt", "ttm") for file in folder.rglob(f"*.{suffix}")},
    key=lambda file: (file.stat().st_size, str(file)),
)
"""From the smallest to the largest."""

needs_files = pytest.mark.skipif(not FILES, reason="no public files of CoppeliaSim are beside the project")


def named(file: Path) -> str:
    return f"{file.parent.name}/{file.name}"


def cases(short: int, files: list[Path] = FILES) -> list[object]:
    """Return the files as parameters of a test: beyond the first `short` ones, it runs only with --long."""
    marks = [() if i < short else (pytest.mark.long,) for i in range(len(files))]
    return [pytest.param(file, id=named(file), marks=mark) for file, mark in zip(files, marks, strict=True)]


def each_of(files: list[Path]) -> list[object]:
    """Return the files as parameters of a test that runs with all of them; there may be none."""
    return cases(len(files), files)


def find(*names: str) -> list[Path]:
    """Return the files of these names, as many as there are."""
    return [file for file in FILES if file.name in names]


def matrix(pose: list[float]) -> np.ndarray:
    """Return the transformation of x y z and a quaternion x y z w."""
    x, y, z, w = pose[3:]
    made = np.eye(4)
    made[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    made[:3, 3] = pose[:3]
    return made
