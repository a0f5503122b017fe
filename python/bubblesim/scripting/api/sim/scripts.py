# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that call child scripts."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from bubblesim.scene_state.shared_data import Scripts
from bubblesim.scripting.api.functions import for_remote_only
from bubblesim.scripting.api.kinds import Handle
from bubblesim.scripting.api.sim.context import ApiContext


class ScriptFunctions(ApiContext):
    """The handle of a script is that of its object."""

    def getScript(self, script_type: int, target: Any = -1, name: str = "") -> int:
        """Return the handle of the script of an object, given by handle or path; -1 if it has none."""
        handle = self._tree.find(target, self._caller.object_handle) if isinstance(target, str) else int(target)
        handle = handle if handle < 0 and handle != self.handle_self else self._resolve(handle)
        return handle if handle >= 0 and self._scripts().has_script(handle) else -1

    def callScriptFunction(self, function: str, script: Any, *arguments: Any) -> Any:
        """Call a global function of a child script and return what it returns.

        ``script`` is its handle, or the path of its object. The old form is accepted, too: 'function@/path' and the
        script's type, sim.scripttype_simulation.
        """
        name, _, path = function.partition("@")
        target = path or script
        if isinstance(target, str):
            handle = self._tree.find(target if target[:1] in "/.:" else f"/{target}", self._caller.object_handle)
        else:
            handle = self._resolve(target)
        return self._scripts().call_script(handle, name, arguments)

    def getScriptFunctions(self, script: int) -> Any:
        """Return an object with the global functions of a child script; for scripts in Python."""
        handle = self._resolve(script)

        def caller(name: str) -> Any:
            return lambda *arguments: self._scripts().call_script(handle, name, arguments)

        return SimpleNamespace(**{name: caller(name) for name in self._scripts().script_functions(handle)})

    def getScripts(self) -> list[dict[str, Any]]:
        """Return all child scripts, for editors: ``handle``, ``object`` (its path), ``file``, ``language`` ('python' or
        'lua') and ``state`` ('running', 'failed', 'ended' or 'stopped')."""
        return self._scripts().descriptions()

    def getScriptText(self, script: Handle) -> str:
        """Return the text of the file of a child script."""
        return self._scripts().text_of(self._resolve(script))

    @for_remote_only
    def initScript(self, script: Handle) -> bool:
        """End a child script and start it again from its file; return whether it runs.

        A stopped simulation loads its scripts when it starts.
        """
        return self._scripts().restart_script(self._resolve(script))

    def getProblems(self) -> dict[str, Any]:
        """Return what is wrong, for editors: ``revision``, which rises with each change, and ``problems`` with
        ``source`` ('scene' or 'script'), ``level`` ('error' or 'warning'), ``object`` (path), ``file``, ``line`` (0 if
        unknown) and ``text``.

        They are the warnings of the scene's files, and for each script those since it was loaded.
        """
        return self._scripts().problems()

    def _scripts(self) -> Scripts:
        scripts = self._caller.shared.scripts
        if scripts is None:
            raise RuntimeError("there are no child scripts here")
        return scripts
