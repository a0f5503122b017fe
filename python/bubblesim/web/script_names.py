# SPDX-License-Identifier: BSD-3-Clause
"""What is doubtful in the text of a script: names that no module has, such as sim.getObjectPositon, and wrong calls."""

from __future__ import annotations

import re
from typing import Any

from bubblesim.scripting.api.functions import MODULES
from bubblesim.scripting.api.missing_names import explain
from bubblesim.scripting.api.old_names import present_name
from bubblesim.web.script_calls import wrong_calls

_STRINGS = r'"(?:\\.|[^"\\\n])*"|' + r"'(?:\\.|[^'\\\n])*'"
_NO_CODE = {
    False: re.compile(r'"""[\s\S]*?"""|' + r"'''[\s\S]*?'''|" + _STRINGS + r"|#[^\n]*"),  # Python
    True: re.compile(r"--\[\[[\s\S]*?\]\]|--[^\n]*|\[\[[\s\S]*?\]\]|" + _STRINGS),  # Lua
}
_NAME = re.compile(r"(?<![\w.:])(\w+)\.(\w+)")
_ASSIGNED = re.compile(r"(?<![\w.:])(\w+)\.(\w+)\s*=(?!=)")
_OTHER_API = "sim-2"  # has objects in place of functions


def warnings(text: str, *, lua: bool) -> list[dict[str, Any]]:
    """Return ``line``, ``text`` and ``level`` of unknown names, and of calls with too few or many arguments."""
    if _OTHER_API in text:
        return []
    code = _NO_CODE[lua].sub(lambda found: _blank(found[0]), text)
    return sorted(_unknown_names(code) + wrong_calls(code, lua=lua), key=lambda problem: problem["line"])


def _blank(text: str) -> str:
    """Return a comment as blanks, and a string as one word, with the same lines."""
    return re.sub(r"[^\n]", " " if text.startswith(("#", "--")) else "s", text)


def _unknown_names(code: str) -> list[dict[str, Any]]:
    """A script may add names of its own."""
    own = {found.groups() for found in _ASSIGNED.finditer(code)}
    problems = []
    for found in _NAME.finditer(code):
        module, name = found.groups()
        if module not in MODULES or (module, name) in own or _is_known(module, name):
            continue
        line = code.count("\n", 0, found.start()) + 1
        problems.append({"line": line, "text": explain(module, name, MODULES), "level": "warning"})
    return problems


def _is_known(module: str, name: str) -> bool:
    api = MODULES[module]
    present = present_name(module, name)
    return hasattr(api, name) or (present is not None and hasattr(api, present))
