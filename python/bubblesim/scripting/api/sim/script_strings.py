# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that run code from strings, call functions later, and describe scripts."""

from __future__ import annotations

from typing import Any

from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.kinds import Handle
from bubblesim.scripting.api.sim.context import ApiContext
from bubblesim.scripting.api.sim.scripts import ScriptFunctions

_MOST_SCHEDULED = 10_000


class ScriptStringFunctions(ScriptFunctions, ApiContext):
    """Code runs with the globals of a script. Lua scripts, and remote clients of a node without --remote-trusted, run
    code in scripts in Lua only."""

    def executeScriptString(self, code: str, script: Any) -> Any:
        """Run code in a script, by its handle or the path of its object, and return its value; of statements None
        (nil). The old form is accepted, too: 'code@/path' and the script's type."""
        text, _, path = code.rpartition("@") if isinstance(script, int) and "@" in code else (code, "", "")
        target = path.strip() or script
        if isinstance(target, str):
            start = self._caller.object_handle
            handle = self._tree.find(target if target[:1] in "/.:" else f"/{target}", start)
        else:
            handle = self._resolve(target)
        if not self._caller.may_use_files and not self._scripts().is_confined(handle):
            raise PermissionError(
                "code in a Python script may do whatever you may: Lua scripts, and remote clients of a node without "
                "--remote-trusted, run code in Lua scripts only"
            )
        return self._scripts().execute(handle, text)

    def scheduleExecution(self, function: Any, arguments: Any, time: float, of_simulation: bool = False) -> int:
        """Call a function, or a global of this name, with a list of arguments when a time has come, s: of
        getSystemTime, or of the simulation. Return a number for cancelScheduledExecution."""
        pending = self._caller.in_each_step
        number = 1
        while ("scheduled", number) in pending:
            number += 1
        if number > _MOST_SCHEDULED:
            raise ValueError(f"a script schedules at most {_MOST_SCHEDULED} calls")
        call = self._caller.callback(function)
        given = list(arguments) if isinstance(arguments, list | tuple) else []
        sim: Any = self

        def check() -> None:
            if (sim.getSimulationTime() if of_simulation else sim.getSystemTime()) >= time:
                del pending["scheduled", number]
                call(*given)

        pending["scheduled", number] = check
        return number

    def cancelScheduledExecution(self, number: int) -> bool:
        """Do not make a call of scheduleExecution; return whether it was to come."""
        return self._caller.in_each_step.pop(("scheduled", number), None) is not None

    def getScriptExecutionCount(self) -> int:
        """Return the number of steps of the simulation before this one (old scripts: 0 in the first call)."""
        return round(float(self._simulation.time) / float(self._simulation.time_step))

    def getScriptStringParam(self, script: Handle, parameter: int) -> str:
        """Return a string of a script: sim.scriptstringparam_text, or name."""
        handle = self._resolve(script)
        if parameter == self.scriptstringparam_text:
            return self._scripts().text_of(handle)
        return self._tree.name(handle) if parameter == self.scriptstringparam_name else ""

    def setScriptStringParam(self, script: Handle, parameter: int, value: Any) -> None:
        """Accept a string of a script; it has no effect: see createScript."""
        self._tree.kind(self._resolve(script))  # raises

    def getScriptProperty(self, script: Handle) -> tuple[int, int]:
        """Return the type of a script, sim.scripttype_simulation, and the handle of its object (old name)."""
        handle = self._resolve(script)
        if not self._scripts().has_script(handle):
            raise ValueError(f"{self._tree.short_path(handle)} has no child script")
        return self.scripttype_simulation, self._shown(handle)

    def getStackTraceback(self, script: Any = None) -> str:
        """Return an empty string: errors of scripts are logged with their calls."""
        return ""

    @differs("functions are called before or after a callback; here only the callback of the script itself")
    def registerScriptFuncHook(self, function: str, hook: Any, before: bool = False) -> int:
        """Return -1: callbacks of the script itself are called, hooks are not."""
        return -1

    def getUserVariables(self) -> list[str]:
        """Return an empty list: the variables of a script are its own."""
        return []

    def getApiFunc(self, script: int, beginning: str) -> list[str]:
        """Return the functions whose names begin with ``beginning``, 'sim.getObject' for example."""
        name = beginning.removeprefix("sim.")
        found = [each for each in dir(type(self)) if each.startswith(name) and not each.startswith("_")]
        return [f"sim.{each}" for each in found if callable(getattr(type(self), each))]

    def getApiInfo(self, script: int, function: str) -> str:
        """Return the documentation of a function."""
        found = getattr(type(self), function.removeprefix("sim."), None)
        return " ".join((found.__doc__ or "").split()) if callable(found) else ""

    def isDeprecated(self, name: str) -> int:
        """Return -1: no function is going to be removed."""
        return -1
