# SPDX-License-Identifier: BSD-3-Clause
"""Check that rospy has the message types of the build with the same definitions."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator

import genpy
import roslib.message

from bubblesim.doctor.build_checks import core_fault
from bubblesim.doctor.finding import Finding, ok, problem, warning


def check_messages() -> Iterator[Finding]:
    """Check each listed type as a Python class."""
    if fault := core_fault():
        yield fault
        return
    from bubblesim import _core

    names: list[str] = _core.messages.message_names()
    missing: dict[str, list[str]] = defaultdict(list)
    others = []
    for name in names:
        kind = _python_class(name)
        if kind is None:
            missing[name.partition("/")[0]].append(name)
        elif kind._md5sum != _core.messages.type_hash(name):
            others.append(name)
    for package, types in missing.items():
        yield warning(
            f"nodes in Python cannot use {', '.join(types)}: no module {package}.msg defines them",
            f"apt-get install python3-{package.replace('_', '-')}; or build and source the workspace of {package}",
        )
    if others:
        yield problem(
            f"the build and Python have different definitions of {', '.join(others)}: their nodes cannot communicate",
            "build again: scripts/setup in a clone, or `catkin build` in your workspace",
        )
    if not missing and not others:
        yield ok(f"{len(names)} message types, the same in Python")


def _python_class(name: str) -> type[genpy.Message] | None:
    try:
        kind: type[genpy.Message] | None = roslib.message.get_message_class(name)
    except (ImportError, ValueError, AttributeError):
        return None
    return kind
