# SPDX-License-Identifier: BSD-3-Clause
"""Names in the text of a script that the modules of scripts do not have, such as sim.getObjectPositon."""

from __future__ import annotations

import re
from typing import Any

from bubblesim.scripting.api.functions import MODULES
from bubblesim.scripting.api.missing_names import explain
from bubblesim.scripting.api.old_names import present_name

_STRINGS = r'"(?:\\.|[^"\\\n])*"|' + r"'(?:\\.|[^'\\\n])*'"
_NO_CODE = {
    False: re.compile(r'"""[\s\S]*?"""|' + r"'''[\s\S]*?'''|" + _STRINGS + r"|#[^\n]*"),  # Python
    True: re.compile(r"--\[\[[\s\S]*?\]\]|--[^\n]*|\[\[[\s\S]*?\]\]|" + _STRINGS),  # Lua
}
_NAME = re.compile(r"(?<![\w.:])(\w+)\.(\w+)")
_ASSIGNED = re.compile(r"(?<![\w.:])(\w+)\.(\w+)\s*=(?!=)")
_OTHER_API = "sim-2"  # has objects in place of functions


def unknown_names(text: str, *, lua: bool) -> list[dict[str, Any]]:
    """Return ``line``, ``text`` and ``level`` of each name that no module has; a script may add names of its own."""
    if _OTHER_API in text:
        return []
    code = _NO_CODE[lua].sub(lambda found: re.sub(r"[^\n]", " ", found[0]), text)
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
