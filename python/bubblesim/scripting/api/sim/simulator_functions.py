# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for the simulator itself: its plugins, named parameters, main loop and window."""

from __future__ import annotations

from typing import Any

from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.kinds import StringOrNothing
from bubblesim.scripting.api.sim.logs import LogFunctions

_REAL_TIME = "the simulator runs in real time if its parameter is set; here the node's option --speed sets it"


class SimulatorFunctions(LogFunctions):
    """What the original's plugins, main loop and window are for: they accept their arguments. Named parameters are
    strings that stay until the node ends."""

    def loadModule(self, file: str, name: str) -> int:
        """Return 1 if there is a module with this name, else -3 (old name)."""
        return 1 if self._is_plugin(name) else -3

    def unloadModule(self, handle: Any) -> int:
        """Accept the handle of a module, which stays; return 1."""
        return 1

    def unloadPlugin(self, name: Any, options: Any = None) -> None:
        """Accept the name of a module, which stays."""

    def getPluginName(self, index: int) -> tuple[str, int] | None:
        """Return the name of a module with an index from 0, and 0; None (nil) behind the last one."""
        names = self._plugin_names()
        return (names[index], 0) if 0 <= index < len(names) else None

    def getLoadedPlugins(self) -> list[str]:
        """Return the names of the modules."""
        return self._plugin_names()

    def getPluginInfo(self, name: str, what: int) -> Any:
        """Return an empty string, or 0 from sim.plugininfo numbers: modules have no versions of their own."""
        return 0 if what in (2, 3, 4) else ""

    def setPluginInfo(self, *arguments: Any) -> None:
        """Accept what a module is to log."""

    def getModuleInfo(self, name: str, what: int) -> Any:
        """Return an empty string, or 0 (old name of getPluginInfo)."""
        return self.getPluginInfo(name, what)

    def sendModuleMessage(self, *arguments: Any) -> int:
        """Accept a message for modules; return 0."""
        return 0

    def getNamedBoolParam(self, name: str) -> bool | None:
        """Return a named parameter as a flag; None (nil) if there is none."""
        text = self._named(name)
        return None if text is None else text.lower() in ("true", "1", "on")

    def getNamedFloatParam(self, name: str) -> float | None:
        """Return a named parameter as a number; None (nil) if there is none."""
        text = self._named(name)
        return None if text is None else float(text)

    def getNamedInt32Param(self, name: str) -> int | None:
        """Return a named parameter as an integer; None (nil) if there is none."""
        text = self._named(name)
        return None if text is None else int(float(text))

    def getStringNamedParam(self, name: str) -> str | None:
        """Return a named parameter; None (nil) if there is none (old name of getNamedStringParam)."""
        return self._named(name)

    def setStringNamedParam(self, name: str, value: StringOrNothing) -> int:
        """Set a named parameter (old name of setNamedStringParam); return 1."""
        sim: Any = self
        sim.setNamedStringParam(name, value or "")
        return 1

    @differs(_REAL_TIME)
    def getRealTimeSimulation(self) -> int:
        """Return 0: the node's option --speed sets how fast simulated time runs."""
        return 0

    @differs(_REAL_TIME)
    def isRealTimeSimulationStepNeeded(self) -> int:
        """Return 0: the node waits for real time itself."""
        return 0

    @differs(_REAL_TIME)
    def adjustRealTimeTimer(self, instance: int, seconds: float) -> int:
        """Accept a change of real time, without effect; return 1."""
        return 1

    def advanceSimulationByOneStep(self) -> int:
        """Do nothing: the node steps; return 1."""
        return 1

    def getSimulationPassesPerRenderingPass(self) -> int:
        """Return 1."""
        return 1

    def setSimulationPassesPerRenderingPass(self, passes: int) -> int:
        """Accept how often the window is drawn; return 1."""
        return 1

    def handleMainScript(self) -> int:
        """Do nothing (main scripts); return 0."""
        return 0

    def handleSimulationScripts(self, call: int, *arguments: Any) -> int:
        """Do nothing (main scripts); return 0."""
        return 0

    def handleExtCalls(self) -> None:
        """Do nothing (main scripts)."""

    def handleGeneralCallbackScript(self, *arguments: Any) -> int:
        """Do nothing (main scripts); return 0."""
        return 0

    def enableEventCallback(self, *arguments: Any) -> int:
        """Accept who follows events, which are not sent; return 1."""
        return 1

    def setEventFilters(self, *arguments: Any) -> None:
        """Accept which events are sent; none are."""

    def getGenesisEvents(self) -> list[Any]:
        """Return an empty list: no events are sent."""
        return []

    def pushUserEvent(self, *arguments: Any) -> None:
        """Accept an event, which is not sent."""

    def systemSemaphore(self, name: str, acquire: bool) -> bool:
        """Return true: programs of one node take turns already."""
        return True

    def setDebugWatchList(self, *arguments: Any) -> None:
        """Accept the names of variables to show."""

    def refreshDialogs(self, degree: int = 0) -> int:
        """Accept that dialogs are to be drawn again; return 1."""
        return 1

    @differs("its window has several pages; here it has one")
    def getPage(self) -> int:
        """Return 0: the window has one page."""
        return 0

    def setPage(self, index: int) -> int:
        """Accept a page of the original's window; return 1."""
        return 1

    @differs("its window has one navigation mode; here each page of the window has its own")
    def getNavigationMode(self) -> int:
        """Return 0: each page of the window has its own."""
        return 0

    def setNavigationMode(self, mode: int) -> int:
        """Accept what the mouse does in the original's window; return 1."""
        return 1

    def moduleEntry(self, handle: int, label: StringOrNothing = None, state: int = -1) -> int:
        """Accept an entry of the original's menu; return a handle."""
        return max(handle, 0)

    def addGhost(self, group: int, handle: int, *more: Any) -> int:
        """Accept a copy of an object to show where it was; return 1."""
        return 1

    def modifyGhost(self, group: int, ghost: int, operation: int, *more: Any) -> int:
        """Accept a change of such copies; return 1."""
        return 1

    def readTexture(self, texture: int, options: int = 0, *more: Any) -> bytes:
        """Return no bytes: textures are those of the file."""
        return b""

    @differs("it uses a serial port; here scripts open none")
    def serialCheck(self, port: int) -> int:
        """Return 0: serial ports cannot be opened by scripts."""
        return 0

    @differs("it writes an old user interface to a file; here it does not")
    def saveUI(self, *arguments: Any) -> int:
        """Return 0: the old user interfaces are not written."""
        return 0

    @differs("it opens old user interfaces of a file; here it does not")
    def loadUI(self, *arguments: Any) -> int:
        """Return 0: the old user interfaces are not read."""
        return 0

    def removeUI(self, ui: int) -> int:
        """Close a user interface of V-REP (old name of deleteUI); return 1."""
        sim: Any = self
        sim.deleteUI(ui)
        return 1

    def getExtensionString(self, handle: int, index: int = -1, key: str = "") -> str:
        """Return an empty string: objects of the file have no extension strings here."""
        return ""

    def setLastError(self, function: str, text: str) -> int:
        """Log an error (old scripts); return 1."""
        self.addLog(self.verbosity_scripterrors, f"{function}: {text}")
        return 1

    def _named(self, name: str) -> str | None:
        sim: Any = self
        value: str | None = sim.getNamedStringParam(name)
        return value or None

    def _plugin_names(self) -> list[str]:
        from bubblesim.scripting.api.functions import MODULES

        return sorted(name for name in MODULES if name != "sim")

    def _is_plugin(self, name: str) -> bool:
        bare = name.removeprefix("sim").removeprefix("Ext")
        return any(each.removeprefix("sim").lower() == bare.lower() for each in self._plugin_names())
