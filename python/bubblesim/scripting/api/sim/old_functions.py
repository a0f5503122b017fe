# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions of older scripts that have no counterpart under another name."""

from __future__ import annotations

from typing import Any

from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.kinds import Handle, StringOrNothing, Vector12
from bubblesim.scripting.api.sim.logs import LogFunctions


class OldFunctions(LogFunctions):
    """For scripts of V-REP and of CoppeliaSim before 4.3. What main scripts call does nothing: the simulation handles
    sensors, joints and child scripts itself, in each step."""

    def getNameSuffix(self, name: StringOrNothing = None) -> tuple[int, str]:
        """Return the number after '#' of a name, -1 if it has none, and the name without it; without a name, the number
        of the script's object."""
        own = name
        if own is None:
            own = str(self._world.name(self._caller.object_handle)) if self._caller.object_handle >= 0 else ""
        bare, mark, number = own.rpartition("#")
        return (int(number), bare) if mark and number.isdigit() else (-1, own)

    def setNameSuffix(self, number: int) -> int:
        """Accept the number of a copy; names are searched by the name of the script's object. Return 1."""
        return 1

    def getObjectSizeFactor(self, handle: Handle) -> float:
        """Return by how much an object was scaled: 1."""
        self._tree.kind(self._resolve(handle))  # raises
        return 1.0

    def getObjectInt32Parameter(self, handle: Handle, parameter: int) -> tuple[int, int]:
        """Return 1, and an integer parameter of an object (old name of getObjectInt32Param)."""
        sim: Any = self
        return 1, sim.getObjectInt32Param(handle, parameter)

    def getObjectFloatParameter(self, handle: Handle, parameter: int) -> tuple[int, float]:
        """Return 1, and a parameter of an object (old name of getObjectFloatParam)."""
        sim: Any = self
        return 1, sim.getObjectFloatParam(handle, parameter)

    def getObjectStringParameter(self, handle: Handle, parameter: int) -> tuple[int, str]:
        """Return 1, and a string of an object (old name of getObjectStringParam)."""
        sim: Any = self
        return 1, sim.getObjectStringParam(handle, parameter)

    def includeRel(self, file: str) -> Any:
        """Run a Lua file beside the script, and return what it returns; in Lua only."""
        raise RuntimeError(
            "sim.includeRel is for scripts in Lua: import the module, or begin the script with 'include'"
        )

    def includeAbs(self, file: str) -> Any:
        """The same; of a path only the name of the file counts."""
        return self.includeRel(file)

    def getObjectUid(self, handle: Handle) -> int:
        """Return a number that no other object has: its handle."""
        handle = self._resolve(handle)
        self._tree.kind(handle)  # raises
        return handle

    def getObjectUniqueIdentifier(self, handle: int) -> Any:
        """Return a number that no other object has; for sim.handle_all those of all objects (old name)."""
        if handle == self.handle_all:
            roots = self._tree.children(self.handle_world)
            return [self._shown(each) for root in roots for each in self._tree.with_all_below(root)]
        return self.getObjectUid(handle)

    def getScriptAssociatedWithObject(self, handle: Handle) -> int:
        """Return the handle of an object's script, -1 if it has none (old name of getScript)."""
        handle = self._resolve(handle)
        self._tree.kind(handle)  # raises
        scripts = self._caller.shared.scripts
        return handle if scripts is not None and scripts.has_script(handle) else -1

    @differs("objects may have customization scripts; here they are not run")
    def getCustomizationScriptAssociatedWithObject(self, handle: Handle) -> int:
        """Return -1: there are no customization scripts."""
        self._tree.kind(self._resolve(handle))  # raises
        return -1

    def getScriptHandle(self, name: Any = None, target: Any = None) -> int:
        """Return the handle of the script of an object, by its name; without a name that of the caller (old name
        of getScript)."""
        wanted = target if target is not None and not isinstance(name, str) else name
        if wanted is None or isinstance(wanted, int):
            return self._resolve(self.handle_self)
        start, path = self._caller.object_handle, str(wanted)
        return self.getScriptAssociatedWithObject(self._tree.find(path if path[:1] in "/.:" else f"/{path}", start))

    def getScriptInt32Param(self, script: int, parameter: int) -> int:
        """Return an integer of a script: 1 for sim.scriptattribute_enabled, else 0."""
        return int(parameter == self.scriptattribute_enabled)

    def setScriptInt32Param(self, script: int, parameter: int, value: int) -> None:
        """Accept an integer of a script; it has no effect."""

    def getScriptAttribute(self, script: int, parameter: int) -> int:
        """Return an integer of a script (old name of getScriptInt32Param)."""
        return self.getScriptInt32Param(script, parameter)

    def setScriptAttribute(self, script: int, parameter: int, value: Any) -> None:
        """Accept an integer or flag of a script; it has no effect (old name)."""

    def boolAnd32(self, first: int, second: int) -> int:
        """Return the bits that both numbers have."""
        return first & second

    def boolOr32(self, first: int, second: int) -> int:
        """Return the bits that one of the numbers has."""
        return first | second

    def boolXor32(self, first: int, second: int) -> int:
        """Return the bits that exactly one of the numbers has."""
        return first ^ second

    def copyMatrix(self, matrix: Vector12) -> list[float]:
        """Return a copy of a matrix."""
        return matrix

    def getLastInfo(self) -> str:
        """Return an empty string: errors and warnings are raised or logged."""
        return ""

    def getLastError(self, what: object = None) -> str | None:
        """Return None (nil): errors are raised."""
        return None

    @differs("messages of its window wait in a queue; here none: callbacks of simUI get events")
    def getSimulatorMessage(self) -> tuple[int, list[int], list[int]]:
        """Return -1: no message of a window waits. Callbacks of simUI get events of widgets."""
        return -1, [0, 0, 0, 0], []

    def setExplicitHandling(self, handle: int, explicit: int) -> int:
        """Accept whether a sensor is handled by scripts; all are handled when they are due. Return 1."""
        return 1

    @differs("some sensors are handled by scripts only; here all when they are due")
    def getExplicitHandling(self, handle: int) -> int:
        """Return 0: sensors are handled when they are due."""
        return 0

    def breakForceSensor(self, sensor: Handle) -> int:
        """Accept a force sensor that breaks; here it does not, with a warning. Return 1."""
        path = self._tree.short_path(self._resolve(sensor))
        self.addLog(self.verbosity_scriptwarnings | self.verbosity_once, f"sim.breakForceSensor: {path} does not break")
        return 1

    def handleSimulationStart(self) -> None:
        """Do nothing (main scripts)."""

    def handleSensingStart(self) -> None:
        """Do nothing (main scripts)."""

    def handleDynamics(self, seconds: float = 0.0) -> int:
        """Do nothing (main scripts); return 1."""
        return 1

    def handleChildScripts(self, call: int, *arguments: Any) -> int:
        """Do nothing (main scripts); return 0."""
        return 0

    def handleCustomizationScripts(self, call: int, *arguments: Any) -> int:
        """Do nothing (main scripts); return 0."""
        return 0

    def handleAddOnScripts(self, call: int, *arguments: Any) -> int:
        """Do nothing (main scripts); return 0."""
        return 0

    def handleSandboxScript(self, call: int, *arguments: Any) -> int:
        """Do nothing (main scripts); return 0."""
        return 0

    def handleEmbeddedScripts(self, call: int, *arguments: Any) -> int:
        """Do nothing (main scripts); return 0."""
        return 0

    def launchThreadedChildScripts(self) -> int:
        """Do nothing (main scripts); return 0."""
        return 0

    def handleChildScript(self, script: int = -2, *arguments: Any) -> int:
        """Do nothing (scripts of V-REP 2); return 0."""
        return 0

    def delegateChildScriptExecution(self) -> int:
        """Do nothing (old scripts); return 0."""
        return 0

    def resumeThreads(self, location: int = 0) -> int:
        """Do nothing (main scripts); return 0."""
        return 0

    def openModule(self, handle: Any = -2) -> int:
        """Do nothing (main scripts); return 1."""
        return 1

    def closeModule(self, handle: Any = -2) -> int:
        """Do nothing (main scripts); return 1."""
        return 1

    def handleModule(self, handle: Any = -2, sensing: bool = False) -> int:
        """Do nothing (main scripts); return 1."""
        return 1

    def handleMechanism(self, handle: int = -2) -> int:
        """Do nothing (main scripts); return 1."""
        return 1

    def handleJointMotion(self) -> None:
        """Do nothing (main scripts)."""

    def handlePath(self, handle: int = -2, seconds: float = 0.0) -> int:
        """Do nothing (main scripts); return 1."""
        return 1

    def handleMill(self, handle: int = -2) -> int:
        """Do nothing (main scripts); return 0."""
        return 0

    def resetMilling(self, handle: int = -2) -> int:
        """Do nothing (main scripts); return 1."""
        return 1

    def resetCollision(self, handle: int = -2) -> int:
        """Do nothing (main scripts); return 1."""
        return 1

    def resetDistance(self, handle: int = -2) -> int:
        """Do nothing (main scripts); return 1."""
        return 1

    def resetProximitySensor(self, handle: int = -2) -> int:
        """Do nothing (main scripts); return 1."""
        return 1

    def resetVisionSensor(self, handle: int = -2) -> int:
        """Do nothing (main scripts); return 1."""
        return 1

    def adjustView(self, view: int, object_handle: int, options: int = 0, label: StringOrNothing = None) -> int:
        """Accept a view of the original's window; the window here has its panel Cameras. Return 1."""
        return 1

    def floatingViewAdd(self, x: float, y: float, width: float, height: float, options: int = 0) -> int:
        """Accept a view in the original's window; return a handle. The window here has its panel Cameras."""
        shared = self._caller.shared
        shared.floating_views += 1
        return shared.floating_views

    def floatingViewRemove(self, view: int) -> int:
        """Accept the handle of a view; return 1."""
        return 1

    def cameraFitToView(self, view: int, handles: Any = None, options: int = 0, scaling: float = 1.0) -> int:
        """Accept a view of the original's window; return 1."""
        return 1
