# SPDX-License-Identifier: BSD-3-Clause
"""The programs that scripts can start, and the restriction to allowed programs."""

from __future__ import annotations

import os
import shutil
from collections.abc import Sequence
from pathlib import Path


def find_program(file: str) -> Path:
    """Return the program with a name or absolute path: in this package, on PATH, or by its path.

    :raises FileNotFoundError: with the searched folders.
    """
    for folder in _own_folders():
        if (folder / file).is_file():
            return folder / file
    on_path = shutil.which(file)
    if on_path is None:
        raise FileNotFoundError(
            f"program '{file}' not found in {' or '.join(map(str, _own_folders()))} or on PATH; "
            "give the name of an installed program or an absolute path"
        )
    return Path(on_path)


def is_allowed(program: Path, allowed: Sequence[str]) -> bool:
    """Return whether a program belongs to a ROS package, including this one, or is in ``allowed``.

    :param allowed: programs by name or path, and folders with programs.
    """
    place = program.parent.resolve() / program.name  # keep a link itself: builds link programs
    if place.parent in [folder.resolve() for folder in _own_folders()]:
        return True
    return (
        any(_covers(each, place) for each in allowed)
        or any(_has_installed(prefix, place) for prefix in _prefixes())
        or any(_has_source(folder, place) for folder in _folders_in("ROS_PACKAGE_PATH"))
    )


def _own_folders() -> list[Path]:
    # In a devel or install space, next to the simulator's program; in the source tree, in scripts/.
    return [Path("/proc/self/exe").resolve().parent, Path(__file__).resolve().parents[3] / "scripts"]


def _prefixes() -> list[Path]:
    """Return the devel and install spaces of the sourced workspaces, and Debian's prefix."""
    return [*_folders_in("CMAKE_PREFIX_PATH"), Path("/usr")]


def _folders_in(variable: str) -> list[Path]:
    return [Path(folder).resolve() for folder in os.environ.get(variable, "").split(":") if folder]


def _has_source(folder: Path, program: Path) -> bool:
    """Return whether a program is in the source of a package below a folder, as Python programs are."""
    return any(place.is_relative_to(folder) and (place / "package.xml").is_file() for place in program.parents)


def _has_installed(prefix: Path, program: Path) -> bool:
    """Return whether a program is in the folder of installed programs of a ROS package: PREFIX/lib/PACKAGE."""
    package = program.parent.name
    return program.parent == prefix / "lib" / package and (prefix / "share" / package / "package.xml").is_file()


def _covers(allowed: str, program: Path) -> bool:
    if "/" not in allowed:
        on_path = shutil.which(allowed)
        return on_path is not None and Path(on_path).parent.resolve() / allowed == program
    place = Path(allowed)
    if place.is_dir():
        return program.is_relative_to(place.resolve())
    return place.parent.resolve() / place.name == program
