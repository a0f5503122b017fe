# SPDX-License-Identifier: BSD-3-Clause
"""Child scripts as editors show them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from bubblesim.scripting.host.child_script import ChildScript
from bubblesim.scripting.language.source import ScriptSourceError, is_lua, read_text


def described(path: str, handle: int, file: Path, script: ChildScript | None) -> dict[str, Any]:
    """Return handle, object, file, language and state of a script.

    :param script: None while the simulation is stopped.
    """
    try:
        in_lua = is_lua(file, read_text(file))
    except ScriptSourceError:
        in_lua = file.suffix == ".lua"
    state = "stopped"
    if script is not None:
        state = "failed" if script.failed else "running" if script.alive else "ended"
    return {
        "handle": handle,
        "object": path,
        "file": str(file),
        "language": "lua" if in_lua else "python",
        "state": state,
    }
