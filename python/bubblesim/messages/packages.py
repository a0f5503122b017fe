# SPDX-License-Identifier: BSD-3-Clause
"""Finds definitions of messages and services: in the workspace, this project and installed packages, in this order."""

from __future__ import annotations

import os
import re
import sys
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from catkin_pkg.packages import find_package_paths  # type: ignore[import-untyped]

from bubblesim.messages.action_messages import action_of
from bubblesim.messages.definition_texts import class_definition, header_definition


@dataclass(frozen=True)
class Definition:
    """The text of a message, service or action, and the file that it is from."""

    text: str
    file: Path


@dataclass
class PackageIndex:
    """Folders of the packages by name, in order of precedence."""

    folders: dict[str, list[Path]] = field(default_factory=dict)
    include_folders: list[Path] = field(default_factory=list)
    python_folders: list[Path] = field(default_factory=list)
    watched: list[Path] = field(default_factory=list)  # a package added here may take precedence over another

    def add(self, name: str, folder: Path) -> None:
        """Add a package after the known ones of the same name."""
        known = self.folders.setdefault(name, [])
        if folder not in known:
            known.append(folder)

    def add_source_space(self, folder: Path) -> None:
        """Add the packages anywhere below a folder, by the names in their package.xml."""
        self.watched.append(folder)
        for relative in sorted(find_package_paths(str(folder), exclude_subspaces=True)):
            name = _package_name(folder / relative / "package.xml")
            if name:
                self.add(name, (folder / relative).resolve())

    def add_share(self, folder: Path) -> None:
        """Add the packages directly below a folder such as /usr/share, named like their folders."""
        for kind in ("msg", "srv", "action"):
            for definitions in sorted(folder.glob(f"*/{kind}")):
                self.add(definitions.parent.name, definitions.parent)

    def find(self, name: str, kind: str) -> Definition | None:
        """Return the definition of `package/Type`; kind is "msg", "srv" or "action"."""
        package, _, short = name.partition("/")
        for folder in self.folders.get(package, []):
            file = folder / kind / f"{short}.{kind}"
            if file.is_file():
                # Comments may have any encoding, and the checksum is computed from the original bytes.
                return Definition(file.read_text(encoding="utf-8", errors="surrogateescape"), file)
            if kind == "msg" and (of_action := action_of(short, folder / "action")):
                return Definition(*of_action)
        return self._find_in_generated(package, short, kind)

    def names(self, kind: str) -> list[str]:
        """Return all names that find() finds in .msg or .srv files (not in headers)."""
        return sorted(
            {
                f"{package}/{file.stem}"
                for package, folders in self.folders.items()
                for folder in folders
                for file in (folder / kind).glob(f"*.{kind}")
            }
        )

    def has_package(self, package: str) -> bool:
        """Return whether a package has definitions, including C++ headers."""
        found = any((folder / kind).is_dir() for folder in self.folders.get(package, []) for kind in ("msg", "srv"))
        return found or any((folder / package).is_dir() for folder in self.include_folders)

    def _find_in_generated(self, package: str, short: str, kind: str) -> Definition | None:
        """Find a definition in generated code: some Debian packages have no .msg files, which are in ros-*-msgs."""
        halves = [short] if kind == "msg" else [f"{short}Request", f"{short}Response"]
        for include in self.include_folders:
            headers = [include / package / f"{half}.h" for half in halves]
            strings = [header_definition(header) for header in headers if header.is_file()]
            if definition := _joined(strings, halves, headers[0]):
                return definition
        for folder in self.python_folders:
            module = folder / package / kind / f"_{short}.py"
            strings = [class_definition(module, half) for half in halves] if module.is_file() else []
            if definition := _joined(strings, halves, module):
                return definition
        return None


def _joined(strings: list[str | None], halves: list[str], file: Path) -> Definition | None:
    """Return the definition joined from `strings`, None if one is missing."""
    found = [text for text in strings if text is not None]
    return Definition("---\n".join(found), file) if len(found) == len(halves) else None


def build_index(
    project: Path | None, build: Path | None, prefixes: Iterable[Path], package_path: Iterable[Path]
) -> PackageIndex:
    """Search all places in order of precedence.

    project: root of this project, None for an installation; build: its build folder, possibly the only one of the two
    inside the workspace; prefixes: CMAKE_PREFIX_PATH; package_path: ROS_PACKAGE_PATH.
    """
    index = PackageIndex(python_folders=[Path(entry) for entry in sys.path if entry])
    workspaces = (find_workspace(start) for start in (project, build) if start)
    for source_space in _unique(_source_space(workspace) for workspace in workspaces if workspace):
        index.add_source_space(source_space)
    if project:
        index.add_share(project / "msg")
    for prefix in [*prefixes, Path("/usr")]:
        for source_space in _devel_source_spaces(prefix):
            index.add_source_space(source_space)
        index.add_share(prefix / "share")
        index.include_folders.append(prefix / "include")
    for folder in package_path:
        if folder.name == "share":
            index.add_share(folder)
        elif folder.is_dir():
            index.add_source_space(folder)
    return index


def machine_index(project: Path | None = None) -> PackageIndex:
    """Return the index of the current environment; project: root of other sources than these."""
    prefixes = os.environ.get("CMAKE_PREFIX_PATH", "").split(":")
    package_path = os.environ.get("ROS_PACKAGE_PATH", "").split(":")
    return build_index(
        project or project_root(),
        None,
        [Path(path) for path in prefixes if path],
        [Path(path) for path in package_path if path],
    )


def project_root() -> Path | None:
    """Return the root of this project's sources, None for an installation."""
    root = Path(__file__).absolute().parents[3]  # not resolved: the workspace may contain links to the sources
    return root if (root / "meta" / "messages.txt").is_file() else None


def find_workspace(start: Path) -> Path | None:
    """Return the catkin workspace that contains a folder, or None."""
    for folder in [start, *start.parents]:
        if (folder / ".catkin_tools").exists() or _is_of_catkin_make(folder):
            return folder
    return None


def _is_of_catkin_make(folder: Path) -> bool:
    """Check for catkin_make: it marks a workspace only after configuration, but links its CMake file before."""
    is_marked = (folder / ".catkin_workspace").exists()
    return is_marked or (folder / "src" / "CMakeLists.txt").resolve().name == "toplevel.cmake"


def _package_name(manifest: Path) -> str | None:
    try:
        return (ElementTree.parse(manifest).findtext("name") or "").strip() or None
    except (OSError, ElementTree.ParseError):
        return None  # catkin reports broken package.xml files


def _source_space(workspace: Path) -> Path:
    for profile in sorted(workspace.glob(".catkin_tools/profiles/*/config.yaml")):
        match = re.search(r"^source_space:\s*(\S+)\s*$", profile.read_text(encoding="utf-8"), re.MULTILINE)
        if match and (workspace / match[1]).is_dir():
            return workspace / match[1]
    return workspace / "src"


def _devel_source_spaces(prefix: Path) -> Iterator[Path]:
    """Yield the source folders of a devel space, listed in its .catkin file."""
    marker = prefix / ".catkin"
    if marker.is_file():
        for entry in marker.read_text(encoding="utf-8").split(";"):
            if entry.strip() and Path(entry.strip()).is_dir():
                yield Path(entry.strip())


def _unique(folders: Iterable[Path]) -> Iterator[Path]:
    seen: set[str] = set()
    for folder in folders:
        if folder.is_dir() and os.path.realpath(folder) not in seen:
            seen.add(os.path.realpath(folder))
            yield folder
