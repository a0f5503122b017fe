# SPDX-License-Identifier: BSD-3-Clause
"""Child scripts for the editor of the page: reading, checking, saving, and the functions that it completes.

A page names a script by its object. The file is the one that the simulator has for it; no other file can be read or
written here.
"""

from __future__ import annotations

import hashlib
import os
import re
import sys
import tempfile
from pathlib import Path
from typing import Any

from bubblesim.scene_files.copies import is_shipped
from bubblesim.scene_state.problems import of_source
from bubblesim.scripting.api import old_names, reference
from bubblesim.scripting.api.functions import MODULES, functions
from bubblesim.scripting.host.callback_names import WHEN_CALLED
from bubblesim.scripting.language.python_code import PythonCode
from bubblesim.scripting.language.script_output import Source
from bubblesim.scripting.language.source import ScriptSourceError, is_lua, read_text
from bubblesim.web.script_names import warnings
from bubblesim.web.threads import in_thread

_CHECKED = "checked_script"  # name of the module that a script has during a check
_MOST_CHARACTERS = 2_000_000


async def read(page: Any, handle: int) -> dict[str, Any]:
    """Return object, file, language, text and the version of a script, and whether its file is ``shipped``."""
    script = await _find(page, handle)
    file = Path(script["file"])
    text = read_text(file)
    return {**script, "text": text, "version": _version(text), "shipped": is_shipped(file)}


async def save(page: Any, handle: int, text: str, version: str) -> dict[str, Any]:
    """Write a script's file and restart the script.

    :param version: of the text that was edited; an empty text overwrites what others have written since.
    :return: the new ``version``, and whether the script is ``running``.
    """
    if len(text) > _MOST_CHARACTERS:
        raise ValueError(f"a script of {len(text)} characters: at most {_MOST_CHARACTERS} are accepted")
    script = await _find(page, handle)
    file = Path(script["file"]).resolve()
    if version and _version(read_text(file)) != version:
        raise FileExistsError(f"{file} was changed by another program since it was opened here")
    await in_thread(_replace, file, text)
    running = await page.node.call("sim.initScript", handle)
    return {"version": _version(text), "running": bool(running)}


async def check(page: Any, handle: int, text: str) -> list[dict[str, Any]]:
    """Compile a string in place of a script's own, without running it; return its errors with ``line`` and ``text``."""
    script = await _find(page, handle)
    return check_text(Path(script["file"]), text[:_MOST_CHARACTERS])


def check_text(file: Path, text: str) -> list[dict[str, Any]]:
    """Return the errors of a string as a script's source; errors of included files are at line 1.

    Without errors, return names that no module has, and calls with a wrong number of arguments, as warnings.
    """
    lua = is_lua(file, text)
    return (_check_lua(text) if lua else _check_python(file, text)) or warnings(text, lua=lua)


def _check_python(file: Path, text: str) -> list[dict[str, Any]]:
    try:
        PythonCode(file, text, [], {}, _CHECKED, Source("", lambda: 0.0, lambda *_: None))
    except ScriptSourceError as error:
        found = of_source("", str(file), str(error))
        if "file not found" in found.text:  # the folders for included files are the node's
            return []
        own = Path(found.file).resolve() == file.resolve()
        return [{"line": max(found.line, 1) if own else 1, "text": found.text if own else str(error)}]
    finally:
        sys.modules.pop(_CHECKED, None)
    return []


def _check_lua(text: str) -> list[dict[str, Any]]:
    from lupa import lua54

    runtime = lua54.LuaRuntime(
        encoding=None, unpack_returned_tuples=True, register_eval=False, register_builtins=False, max_memory=1 << 28
    )
    code = f"--{text}" if text.startswith("#") else text
    found = runtime.globals()[b"load"](code.encode(), b"=script", b"t")
    problem = found[1].decode(errors="backslashreplace") if isinstance(found, tuple) else ""
    placed = re.fullmatch(r"script:(\d+): (.*)", problem, re.DOTALL)
    if placed is None:
        return [{"line": 1, "text": problem}] if problem else []
    return [{"line": int(placed[1]), "text": placed[2]}]


async def api(_page: Any) -> dict[str, Any]:
    """Return what the editor completes: ``functions`` by module, with name, call, text and how each ``differs`` from
    CoppeliaSim's; ``constants`` of sim; ``callbacks``, with the text of each by its name; and ``old`` names of
    functions, with the present ones."""
    return {
        "functions": {
            name: [
                {
                    "name": each.name,
                    "call": reference.call(f"{name}.{each.name}", each),
                    "text": reference.text(each),
                    "differs": reference.differing(each),
                }
                for each in functions(module)
                if not each.for_remote_only
            ]
            for name, module in MODULES.items()
        },
        "constants": sorted(
            name for name in dir(MODULES["sim"]) if not name.startswith("_") and isinstance(_member(name), int)
        ),
        "callbacks": WHEN_CALLED,
        "old": old_names.of_functions(
            {name: [each.name for each in functions(module)] for name, module in MODULES.items()}
        ),
    }


def _member(name: str) -> Any:
    return getattr(MODULES["sim"], name)


async def _find(page: Any, handle: int) -> dict[str, Any]:
    for script in await page.node.call("sim.getScripts"):
        if script["handle"] == handle:
            return dict(script)
    raise ValueError(f"the object {handle} has no child script")


def _version(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def _replace(file: Path, text: str) -> None:
    """Replace a file at once, so that no one reads half of it."""
    mode = file.stat().st_mode
    number, name = tempfile.mkstemp(dir=file.parent, prefix=f".{file.name}.")
    try:
        with os.fdopen(number, "w", encoding="utf-8") as stream:
            stream.write(text)
            os.fchmod(stream.fileno(), mode)
        Path(name).replace(file)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise
