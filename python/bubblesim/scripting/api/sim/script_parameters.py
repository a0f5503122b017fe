# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for the simulation parameters of scripts."""

from __future__ import annotations

from typing import Any

from bubblesim.scripting.api.kinds import Handle
from bubblesim.scripting.api.sim.context import ApiContext

_WORDS: dict[str, Any] = {"nil": None, "true": True, "false": False}


class ScriptParameterFunctions(ApiContext):
    """A script has parameters, strings by name, of the file or set by scripts and programs. What is set during a run
    stays until the node ends."""

    def getScriptSimulationParameter(self, script: Any, name: str, force_string: bool = False) -> Any:
        """Return a parameter of a script as a number, true, false or a string; None (nil) if there is none.

        ``script`` is its handle, that of its object or sim.handle_self; for sim.handle_all, sim.handle_tree and
        handle_chain (all scripts of the scene, and below or above this one) a list of values and one of handles.
        """
        if script in (self.handle_all, self.handle_tree, self.handle_chain):
            found = [handle for handle in self._scripts_meant(script) if self._parameter(handle, name) is not None]
            return [self._parameter_value(handle, name, force_string) for handle in found], found
        return self._parameter_value(self._script(script), name, force_string)

    def setScriptSimulationParameter(self, script: Any, name: str, value: Any, user: object = None) -> int:
        """Set a parameter of a script; return the number of scripts that have it now. ``script``: see
        getScriptSimulationParameter; of several scripts, those that have the parameter."""
        text = _as_string(value)
        if script in (self.handle_all, self.handle_tree, self.handle_chain):
            chosen = [handle for handle in self._scripts_meant(script) if self._parameter(handle, name) is not None]
        else:
            chosen = [self._script(script)]
        for handle in chosen:
            self._caller.shared.script_parameters[handle, name] = text
        return len(chosen)

    def getUserParameter(self, handle: Handle, name: str) -> Any:
        """Return a parameter of an object's script (old name)."""
        return self._parameter_value(self._resolve(handle), name, False)

    def setUserParameter(self, handle: Handle, name: str, value: Any) -> None:
        """Set a parameter of an object's script (old name)."""
        self._caller.shared.script_parameters[self._resolve(handle), name] = _as_string(value)

    def _script(self, script: Any) -> int:
        if isinstance(script, str):
            return self._tree.find(script if script[:1] in "/.:" else f"/{script}", self._caller.object_handle)
        handle = self._resolve(int(script))
        self._tree.kind(handle)  # raises
        return handle

    def _scripts_meant(self, what: int) -> list[int]:
        """Return the objects of the scene, or below or above that of the script."""
        own = self._caller.object_handle
        if what == self.handle_tree and own >= 0:
            return self._tree.with_all_below(own)[1:]
        if what == self.handle_chain:
            above = []
            while own >= 0 and (own := self._tree.parent(own)) >= 0:
                above.append(own)
            return above
        return [each for root in self._tree.children(self.handle_world) for each in self._tree.with_all_below(root)]

    def _parameter(self, handle: int, name: str) -> str | None:
        """Return the string of a parameter: as it was set last, or that of the file."""
        known: str | None = self._caller.shared.script_parameters.get((handle, name))
        if known is not None:
            return known
        of_file: list[tuple[str, str, str]] = self._world.script_parameters(handle)
        return next((value for of, _, value in of_file if of == name), None)

    def _parameter_value(self, handle: int, name: str, force_string: bool) -> Any:
        text = self._parameter(handle, name)
        return text if text is None or force_string else _value_of(text)


def _value_of(text: str) -> Any:
    if text in _WORDS:
        return _WORDS[text]
    try:
        return int(text)
    except ValueError:
        pass
    try:
        return float(text)
    except ValueError:
        return text


def _as_string(value: Any) -> str:
    if isinstance(value, bytes):
        return value.decode(errors="surrogateescape")
    if value is None or isinstance(value, bool):
        return {None: "nil", True: "true", False: "false"}[value]
    return f"{value:.17g}" if isinstance(value, float) else str(value)
