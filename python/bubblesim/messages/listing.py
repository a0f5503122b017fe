# SPDX-License-Identifier: BSD-3-Clause
"""The program messages: lists the types that scripts can use, their checksums and definition files."""

from __future__ import annotations

import argparse
import fnmatch
import sys
from collections.abc import Iterator

from bubblesim import _core
from bubblesim.messages.names import did_you_mean, nearest_names
from bubblesim.messages.packages import machine_index
from bubblesim.messages.specs import SpecError, Specs


def main(arguments: list[str]) -> int:
    """Run the program; return the exit code."""
    options = _parse_arguments(arguments)
    kind = "srv" if options.services else "msg"
    specs = Specs(machine_index())
    names = sorted({*_listed(kind), *specs.index.names(kind)})
    chosen = [name for name in names if _matches(name, options.pattern)]
    if not chosen:
        hint = did_you_mean(nearest_names(options.pattern, names))
        print(f"error: no type matches '{options.pattern}'{hint}", file=sys.stderr)
        return 1
    rows = list(_rows(chosen, kind, specs))
    widths = [max((len(row[column]) for row in rows), default=0) for column in range(3)]
    for row in rows:
        print(*(cell.ljust(width) for cell, width in zip(row, widths, strict=False)), row[3], sep="  ")
    return 0


def _parse_arguments(arguments: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="messages",
        description="Lists the types that scripts can use: name, md5, state and the file that defines each.",
        epilog="states: listed (compiled), outdated (listed, but the definition has changed since the build), run-time "
        "(not listed: read from its definition when a script uses it; 'rosrun bubblesim add_message' lists it). "
        "exit codes: 0 success, 1 no type matches, 2 bad usage",
    )
    parser.add_argument("pattern", nargs="?", default="", help="part of a name, or a shell pattern such as '*/Pose*'")
    parser.add_argument("--services", action="store_true", help="service types instead of message types")
    return parser.parse_args(arguments)


def _matches(name: str, pattern: str) -> bool:
    is_glob = any(character in pattern for character in "*?[")
    return fnmatch.fnmatch(name.lower(), pattern.lower() if is_glob else f"*{pattern.lower()}*")


def _listed(kind: str) -> list[str]:
    names: list[str] = _core.messages.message_names() if kind == "msg" else _core.messages.service_names()
    return names


def _rows(names: list[str], kind: str, specs: Specs) -> Iterator[tuple[str, str, str, str]]:
    listed = set(_listed(kind))
    compiled_md5 = _core.messages.type_hash if kind == "msg" else _core.messages.service_type_hash
    for name in names:
        md5 = file = "-"
        try:
            file = str(specs.load(name, kind))
            md5 = specs.md5((specs.messages if kind == "msg" else specs.services)[name])
        except SpecError as error:
            print(f"warning: {error}", file=sys.stderr)
        if name not in listed:
            yield name, md5, "run-time", file
        else:
            compiled = str(compiled_md5(name))
            yield name, compiled, "listed" if md5 in (compiled, "-") else "outdated", file
