# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that add child scripts from strings."""

from __future__ import annotations

from typing import Any

from bubblesim.scripting.api.kinds import Handle
from bubblesim.scripting.api.sim.context import ApiContext


class AddedScriptFunctions(ApiContext):
    """Such a script begins in the next step, and ends with the run, as its object does. Lua scripts and remote clients
    add scripts in Lua only, which run in the sandbox."""

    def createScript(self, script_type: int, text: str, options: int = 0, language: str = "") -> int:
        """Create a script and return its object, a dummy, to attach to another object with setObjectParent.

        ``language`` is 'lua', the default, or 'python'; a first line '#python' counts, too."""
        made = self._script_object(script_type)
        self._begin(made, text, language)
        return made

    def addScript(self, script_type: int, *more: Any) -> int:
        """Create a script without code and return its handle (old name of createScript): see setScriptText and
        associateScriptWithObject. With code, and a language behind it, the same as createScript."""
        made = self._script_object(script_type)
        given = [each for each in more if isinstance(each, str)]
        if given:
            self._begin(made, given[0], given[1] if len(given) > 1 else "")
        return made

    def setScriptText(self, script: Handle, text: str) -> int:
        """Give code to a script of addScript, which begins when it is associated with an object (old name); return
        1."""
        self._check_added(script)
        self._caller.shared.settings[str, f"text of script {script}"] = text
        return 1

    def associateScriptWithObject(self, script: Handle, handle: Handle) -> int:
        """Let a script of addScript be that of an object, and begin (old name); return 1."""
        self._check_added(script)
        text = self._caller.shared.settings.get((str, f"text of script {script}"), "")
        self._begin(self._resolve(handle), str(text), "")
        return 1

    def _script_object(self, script_type: int) -> int:
        supported = (self.scripttype_simulation, self.scripttype_customization)
        if script_type not in supported:
            raise ValueError(
                f"scripts of the type {script_type} cannot be added: use sim.scripttype_simulation or "
                "scripttype_customization"
            )
        made = self._caller.shared.dummies.create(self._world, "Script", 0.01, temporary=not self._is_stopped())
        return made.handle

    def _begin(self, handle: int, text: str, language: str) -> None:
        if language not in ("", "lua", "python"):
            raise ValueError(f"the language of a script is 'lua' or 'python', found '{language}'")
        in_python = language == "python" or text.lstrip().startswith("#python")
        if in_python and not self._caller.may_use_files:
            raise PermissionError(
                "a script in Python may do whatever you may: Lua scripts and remote clients of a node without "
                "--remote-trusted add scripts in Lua"
            )
        scripts = self._caller.shared.scripts
        if scripts is None:
            raise RuntimeError("there are no child scripts here")
        scripts.add_text(handle, text, "py" if in_python else "lua")

    def _check_added(self, script: int) -> None:
        if not self._tree.is_created_dummy(script):
            raise ValueError(f"{script} is not a script of sim.addScript: the code of other scripts is in files")
