# SPDX-License-Identifier: BSD-3-Clause
"""Calls in the text of a script that have too few or too many arguments, such as sim.setJointPosition(joint)."""

from __future__ import annotations

import inspect
import re
from functools import cache
from typing import Any

from bubblesim.scripting.api.functions import MODULES, functions

_CALL = re.compile(r"(?<![\w.:])(\w+)\.(\w+)\s*\(")
_OPENING, _CLOSING = "([{", ")]}"
_UNCOUNTED = re.compile(r"\.\.\.|\*\s*\w|\b(?:lambda|function|for|yield)\b|^\s*\w+\s*=(?!=)", re.MULTILINE)
"""What is not one argument for each comma: lists that are unpacked, functions with commas of their own, names."""


def wrong_calls(code: str, *, lua: bool) -> list[dict[str, Any]]:
    """Return ``line``, ``text`` and ``level`` of each call whose number of arguments is wrong.

    :param code: the text without comments, in which strings are not empty and have no brackets or commas.
    """
    problems = []
    for found in _CALL.finditer(code):
        signature = _signatures().get((found[1], found[2]))
        arguments = _arguments(code, found.end()) if signature else None
        if signature is None or arguments is None or any(_UNCOUNTED.search(each) for each in arguments):
            continue
        reported = _misfit(signature, arguments, lua=lua)
        if reported:
            line = code.count("\n", 0, found.start()) + 1
            names = ", ".join(signature.parameters)
            text = f"{found[1]}.{found[2]}({names}): {reported}"
            problems.append({"line": line, "text": text, "level": "warning"})
    return problems


@cache
def _signatures() -> dict[tuple[str, str], inspect.Signature]:
    return {(name, each.name): each.signature for name, module in MODULES.items() for each in functions(module)}


def _misfit(signature: inspect.Signature, arguments: list[str], *, lua: bool) -> str:
    """Return what is wrong, in the words of Python; empty if the call may be right."""
    if lua:  # surplus arguments are ignored, and a call at the end may return several values
        if arguments and arguments[-1].rstrip().endswith(")"):
            return ""
        arguments = arguments[: len(signature.parameters)]
    try:
        signature.bind(*arguments)
    except TypeError as error:
        return str(error)
    return ""


def _arguments(code: str, begin: int) -> list[str] | None:
    """Return the arguments behind an opening bracket; None if it is not closed yet."""
    parts = []
    depth = 0
    last = begin
    for place in range(begin, len(code)):
        sign = code[place]
        if sign in _OPENING:
            depth += 1
        elif sign in _CLOSING and depth:
            depth -= 1
        elif depth == 0 and (sign == "," or sign in _CLOSING):
            parts.append(code[last:place])
            last = place + 1
            if sign in _CLOSING:
                return [each for each in parts if each.strip()]
    return None
