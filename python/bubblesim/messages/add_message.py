# SPDX-License-Identifier: BSD-3-Clause
"""The program add_message: adds types to the lists of the build and rebuilds, so that they are compiled and checked."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterable
from pathlib import Path

from bubblesim.messages.lists import add_to_list
from bubblesim.messages.names import did_you_mean, nearest_names, type_name
from bubblesim.messages.packages import PackageIndex, machine_index, project_root
from bubblesim.messages.rebuild import BuildError, rebuild
from bubblesim.messages.specs import SpecError, Specs

_FINE, _BUILD_FAILED, _BAD_INPUT = 0, 1, 2
_LISTS = {"msg": "messages.txt", "srv": "services.txt"}


def main(arguments: list[str]) -> int:
    """Run the program; return the exit code."""
    options = _parse_arguments(arguments)
    if options.project is None or not (options.project / "meta").is_dir():
        return _fail(
            [
                "bubblesim's sources, which contain the lists, are not found, and an installed bubblesim needs no "
                "lists: it reads the definitions of types, also of a workspace whose setup.bash is sourced. To list "
                "them in a clone: --project DIR"
            ]
        )
    project: Path = options.project.absolute()
    problems: list[str] = []
    kinds = _find_all(options.types, Specs(machine_index(project)), problems)
    if problems:
        return _fail(problems)
    for name, kind in kinds.items():
        print(add_to_list(project / "meta" / _LISTS[kind], name), flush=True)
    if options.no_build:
        return _FINE
    started = time.monotonic()
    try:
        rebuild(project)
    except BuildError as error:
        return _fail([str(error)], _BUILD_FAILED)
    print(f"{', '.join(kinds)}: compiled in {time.monotonic() - started:.1f} s", flush=True)
    return _FINE


def _parse_arguments(arguments: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="add_message",
        description="Adds message and service types to bubblesim's meta/messages.txt and meta/services.txt, and "
        "rebuilds. Types that are not listed also work, but their definitions are read in each run.",
        epilog="exit codes: 0 success, 1 the build failed, 2 bad usage or an unusable type (nothing is written)",
    )
    parser.add_argument("types", nargs="+", metavar="PKG/TYPE", help="PKG/srv/TYPE if a message has the same name")
    parser.add_argument("--no-build", action="store_true", help="only write the lists")
    parser.add_argument(
        "--project", type=Path, default=project_root(), metavar="DIR", help="bubblesim's sources (default: %(default)s)"
    )
    return parser.parse_args(arguments)


def _find_all(strings: Iterable[str], specs: Specs, problems: list[str]) -> dict[str, str]:
    """Return name and kind ("msg" or "srv") of each type."""
    kinds: dict[str, str] = {}
    for text in strings:
        name = type_name(text)
        if name is None:
            problems.append(f"'{text}' is not a type name, expected package/Type such as geometry_msgs/Twist")
            continue
        kind = _kind_of(text, name, specs.index)
        if kind is None:
            problems.append(_not_found(name, specs))
            continue
        try:
            specs.load(name, kind)
        except SpecError as error:
            problems.append(str(error))
        kinds[name] = kind
    return kinds


def _kind_of(text: str, name: str, index: PackageIndex) -> str | None:
    kinds = [kind for kind in ("msg", "srv") if f"/{kind}/" in text] or ["msg", "srv"]
    return next((kind for kind in kinds if index.find(name, kind)), None)


def _not_found(name: str, specs: Specs) -> str:
    near = nearest_names(name, [*specs.index.names("msg"), *specs.index.names("srv")])
    return f"{name} is not found on this machine{did_you_mean(near) or '; ' + specs.not_found(name, 'msg')}"


def _fail(problems: list[str], code: int = _BAD_INPUT) -> int:
    for problem in problems:
        print(f"error: {problem}", file=sys.stderr)
    return code
