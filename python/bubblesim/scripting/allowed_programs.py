# SPDX-License-Identifier: BSD-3-Clause
"""The programs that scripts can start, and those that confined scripts and remote clients may start."""

from __future__ import annotations

import os
import re
import shutil
import xml.etree.ElementTree as ElementTree
from collections.abc import Sequence
from pathlib import Path

_OWN_SOURCE = Path(__file__).resolve().parents[3]
_RENAMING = re.compile(r"__(name|ns):=")
_SPECIAL = re.compile(r"__\w+:=")


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
    """Return whether a program is in ``allowed``, or its ROS package allows it.

    A package allows the programs that its package.xml lists: ``<export><bubblesim programs="NAME NAME"/></export>``.

    :param allowed: programs by name or path, and folders with programs.
    """
    place = program.parent.resolve() / program.name  # keep a link itself: builds link programs
    if any(_covers(each, place) for each in allowed):
        return True
    manifest = _manifest_of(place)
    return manifest is not None and place.name in _listed_programs(manifest)


def refused_argument(arguments: Sequence[str]) -> str | None:
    """Return the argument that a confined caller must not pass: it lets a ROS program write files or open ports."""
    return next((each for each in arguments if _SPECIAL.match(each) and not _RENAMING.match(each)), None)


def _own_folders() -> list[Path]:
    # In a devel or install space, next to the simulator's program; in the source tree, in scripts/.
    return [Path("/proc/self/exe").resolve().parent, _OWN_SOURCE / "scripts"]


def _prefixes() -> list[Path]:
    """Return the devel and install spaces of the sourced workspaces, and Debian's prefix."""
    return [*_folders_in("CMAKE_PREFIX_PATH"), Path("/usr")]


def _folders_in(variable: str) -> list[Path]:
    return [Path(folder).resolve() for folder in os.environ.get(variable, "").split(":") if folder]


def _manifest_of(program: Path) -> Path | None:
    """Return the package.xml of the ROS package that a program belongs to; None for other programs."""
    package = program.parent.name
    candidates = [prefix / "share" / package for prefix in _prefixes() if program.parent == prefix / "lib" / package]
    if program.parent in [folder.resolve() for folder in _own_folders()]:
        candidates.append(_OWN_SOURCE)  # a devel space has no package.xml
    sources = _folders_in("ROS_PACKAGE_PATH")
    candidates += [place for place in program.parents if any(place.is_relative_to(folder) for folder in sources)]
    return next((place / "package.xml" for place in candidates if (place / "package.xml").is_file()), None)


def _listed_programs(manifest: Path) -> set[str]:
    """Return the programs that a package.xml allows; none if it cannot be read."""
    try:
        exports = ElementTree.parse(manifest).iterfind("export/bubblesim")
        return {name for export in exports for name in export.get("programs", "").split()}
    except (OSError, ElementTree.ParseError):
        return set()


def _covers(allowed: str, program: Path) -> bool:
    if "/" not in allowed:
        on_path = shutil.which(allowed)
        return on_path is not None and Path(on_path).parent.resolve() / allowed == program
    place = Path(allowed)
    if place.is_dir():
        return program.is_relative_to(place.resolve())
    return place.parent.resolve() / place.name == program
