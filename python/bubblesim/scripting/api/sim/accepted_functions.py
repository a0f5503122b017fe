# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for parts of CoppeliaSim that are not here: they accept their arguments, with a warning."""

from __future__ import annotations

from typing import Any

from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.kinds import Handle
from bubblesim.scripting.api.sim.logs import LogFunctions

_NO_SERIAL = "it uses a serial port; here scripts open none"


class AcceptedFunctions(LogFunctions):
    """Objects that scripts cannot make here are dummies with a pose and a name; a warning states it once."""

    @differs("it makes a sensor that connects bodies and measures; here it is a dummy: sensors are made in files")
    def createForceSensor(self, options: int, integers: Any = None, floats: Any = None, more: Any = None) -> int:
        """Return a dummy in place of a force sensor: sensors are made in the scene's file."""
        return self._stand_in_for("Force_sensor", "createForceSensor", "it is a dummy, which measures nothing")

    @differs("linked dummies close loops of the physics; here those of files do, of scripts not")
    def setLinkDummy(self, dummy: Handle, other: int) -> int:
        """Keep which dummy is linked to another one; -1: none. Return 1."""
        first = self._resolve(dummy)
        self._tree.dummy(first)  # raises
        settings = self._caller.shared.settings
        before = settings.get((int, f"link of {first}"), -1)
        if before >= 0:
            settings[int, f"link of {before}"] = -1
        second = -1 if other < 0 else self._resolve(other)
        settings[int, f"link of {first}"] = second
        if second >= 0:
            self._tree.dummy(second)  # raises
            settings[int, f"link of {second}"] = first
        return 1

    def getLinkDummy(self, dummy: Handle) -> int:
        """Return the dummy that is linked to one; -1 if there is none."""
        handle = self._resolve(dummy)
        self._tree.dummy(handle)  # raises
        return int(self._caller.shared.settings.get((int, f"link of {handle}"), -1))

    def getScriptName(self, script: int) -> str:
        """Return the name of a script's object (old style)."""
        return self._tree.name(self._resolve(script))

    @differs("it sets a variable of another script; here callScriptFunction calls one of its functions")
    def setScriptVariable(self, name: str, script: int, value: Any) -> int:
        """Return -1: call a function of the script instead."""
        self._warn(
            "setScriptVariable", "variables of other scripts cannot be set: call a function with callScriptFunction"
        )
        return -1

    def addObjectCustomData(self, handle: Handle, header: int, data: Any, size: Any = None) -> int:
        """Attach bytes or a string to an object by a number (old name of writeCustomDataBlock); return 1."""
        owner = self._resolve(handle)
        self._tree.kind(owner)  # raises
        if not isinstance(data, str | bytes):
            raise TypeError(f"the data of an object are a string or bytes, found {type(data).__name__}")
        self._caller.shared.custom_data[owner, f"#{header}"] = data
        return 1

    def getObjectCustomData(self, handle: Handle, header: int) -> str | bytes | None:
        """Return what was attached with addObjectCustomData, or in the file; None (nil) if there is nothing."""
        owner, tag = self._resolve(handle), f"#{header}"
        data: str | bytes | None = self._caller.shared.custom_data.get((owner, tag))
        return self._world.file_data(owner).get(tag) if data is None else data

    @differs("materials are objects; here they are those of the file")
    def getMaterialId(self, name: str) -> int:
        """Return -1: materials are those of the file."""
        return -1

    @differs("it gives a shape another friction; here materials are those of the file")
    def setShapeMaterial(self, shape: Handle, material: int) -> int:
        """Accept the material of a shape: materials are those of the file. Return 1."""
        return 1

    def setModuleInfo(self, *arguments: Any) -> None:
        """Accept what a module is to log."""

    def registerScriptFunction(self, name: str, help_text: str = "") -> int:
        """Accept the help of a function; return 1."""
        return 1

    def registerScriptVariable(self, name: str) -> int:
        """Accept a variable; return 1."""
        return 1

    def announceSceneContentChange(self) -> int:
        """Accept a change of the scene; return 1."""
        return 1

    def addBanner(self, *arguments: Any) -> int:
        """Accept a banner in the original's window; return 1."""
        return 1

    def removeBanner(self, banner: int) -> int:
        """Accept the handle of a banner; return 1."""
        return 1

    def setStepper(self, *arguments: Any) -> None:
        """Accept who steps the simulation."""

    @differs(_NO_SERIAL)
    def serialOpen(self, port: Any, baud: int = 9600) -> int:
        """Return -1: serial ports cannot be opened by scripts."""
        self._warn("serialOpen", "serial ports cannot be opened")
        return -1

    @differs(_NO_SERIAL)
    def serialClose(self, port: int) -> int:
        """Return 0."""
        return 0

    @differs(_NO_SERIAL)
    def serialSend(self, port: int, data: Any) -> int:
        """Return 0: nothing is sent."""
        return 0

    @differs(_NO_SERIAL)
    def serialRead(self, port: int, length: int = 0, *more: Any) -> None:
        """Return None (nil)."""

    def _stand_in_for(self, name: str, function: str, why: str) -> int:
        self._warn(function, why)
        return self._caller.shared.dummies.create(self._world, name, 0.01, temporary=not self._is_stopped()).handle

    def _warn(self, function: str, why: str) -> None:
        self.addLog(self.verbosity_scriptwarnings | self.verbosity_once, f"sim.{function}: {why}")
