# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for calculation objects of scenes before CoppeliaSim 4.2, which are not read."""

from __future__ import annotations

import math
from typing import Any

from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.kinds import Integers
from bubblesim.scripting.api.sim.joints import JointFunctions
from bubblesim.scripting.api.sim.logs import LogFunctions

_NOT_READ = "it works on calculation objects of scenes before 4.2; here they are not read: use simIK and simOMPL"


class OldKinematicsFunctions(JointFunctions, LogFunctions):
    """IK groups, mechanisms and planning tasks of old scenes: their functions return what they do where nothing is
    found, with a warning that names the module to use."""

    @differs(_NOT_READ)
    def getIkGroupHandle(self, name: str) -> int:
        """Accept the name of an IK group; return 0."""
        self._instead("getIkGroupHandle", f"the IK group '{name}' is not read from old scenes: use simIK")
        return 0

    @differs(_NOT_READ)
    def createIkGroup(self, options: int = 0, integers: Any = None, floats: Any = None, more: Any = None) -> int:
        """Accept an IK group; return 0."""
        self._instead("createIkGroup", "use simIK.createGroup")
        return 0

    @differs(_NOT_READ)
    def removeIkGroup(self, group: int) -> int:
        """Accept the handle of an IK group; return 1."""
        return 1

    @differs(_NOT_READ)
    def createIkElement(self, group: int, options: int, integers: Any, floats: Any = None, more: Any = None) -> int:
        """Accept an element of an IK group; return 1."""
        self._instead("createIkElement", "use simIK.addElementFromScene")
        return 1

    @differs(_NOT_READ)
    def handleIkGroup(self, group: int = -2) -> int:
        """Return sim.ikresult_not_performed."""
        return self.ikresult_not_performed

    @differs(_NOT_READ)
    def checkIkGroup(self, group: int, joints: Integers, options: Any = None) -> tuple[int, list[float]]:
        """Return sim.ikresult_not_performed and the positions of the joints."""
        self._instead("checkIkGroup", "use simIK.handleGroup")
        return self.ikresult_not_performed, [self.getJointPosition(joint) for joint in joints]

    @differs(_NOT_READ)
    def setIkGroupProperties(self, group: int, method: int, iterations: int, damping: float, more: Any = None) -> int:
        """Accept the settings of an IK group; return 1."""
        return 1

    @differs(_NOT_READ)
    def setIkElementProperties(
        self, group: int, tip: int, constraints: int, precision: Any = None, weight: Any = None, more: Any = None
    ) -> int:
        """Accept the settings of an element of an IK group; return 1."""
        return 1

    @differs(_NOT_READ)
    def computeJacobian(self, group: int, options: int = 0, more: Any = None) -> int:
        """Return -1."""
        self._instead("computeJacobian", "use simIK.computeGroupJacobian")
        return -1

    @differs(_NOT_READ)
    def getIkGroupMatrix(self, group: int, options: int = 0) -> tuple[list[float], list[int]]:
        """Return an empty matrix."""
        self._instead("getIkGroupMatrix", "use simIK.computeGroupJacobian")
        return [], [0, 0]

    @differs(_NOT_READ)
    def exportIk(self, file: str, reserved: Any = None, more: Any = None) -> int:
        """Return 0: IK groups are not written."""
        return 0

    @differs(_NOT_READ)
    def generateIkPath(self, group: int, joints: Integers, points: int, *more: Any) -> None:
        """Return None (nil), as if no path were found."""
        self._instead("generateIkPath", "use simIK.generatePath")

    @differs(_NOT_READ)
    def getConfigForTipPose(self, group: int, joints: Integers, *more: Any) -> None:
        """Return None (nil), as if no configuration were found."""
        self._instead("getConfigForTipPose", "use simIK.findConfigs")

    @differs(_NOT_READ)
    def getMechanismHandle(self, name: str) -> int:
        """Accept the name of a mechanism; return 0."""
        return 0

    @differs(_NOT_READ)
    def getPathPlanningHandle(self, name: str) -> int:
        """Accept the name of a planning task; return 0."""
        self._instead("getPathPlanningHandle", f"the planning task '{name}' is not read from old scenes: use simOMPL")
        return 0

    @differs(_NOT_READ)
    def searchPath(self, task: int, seconds: float = 0.0, interval: float = 0.0) -> int:
        """Return 0, as if no path were found."""
        self._instead("searchPath", "use simOMPL")
        return 0

    @differs(_NOT_READ)
    def initializePathSearch(self, task: int, seconds: float = 0.0, interval: float = 0.0) -> int:
        """Return -1, as if the task could not begin."""
        self._instead("initializePathSearch", "use simOMPL")
        return -1

    @differs(_NOT_READ)
    def performPathSearchStep(self, search: int, end: bool = False) -> int:
        """Return 0, as if no path were found."""
        return 0

    @differs(_NOT_READ)
    def findIkPath(self, *arguments: Any) -> None:
        """Return None (nil), as if no path were found."""
        self._instead("findIkPath", "use simIK.generatePath")

    @differs(_NOT_READ)
    def findMpPath(self, *arguments: Any) -> None:
        """Return None (nil), as if no path were found."""
        self._instead("findMpPath", "use simOMPL")

    @differs(_NOT_READ)
    def getMpConfigForTipPose(self, *arguments: Any) -> None:
        """Return None (nil), as if no configuration were found."""
        self._instead("getMpConfigForTipPose", "use simIK.findConfigs")

    @differs(_NOT_READ)
    def getMotionPlanningHandle(self, name: str) -> int:
        """Accept the name of a planning task; return 0."""
        return 0

    @differs("it calls a server in Python; here it raises an error: use sim.moveToConfig or ruckigPos")
    def generateTimeOptimalTrajectory(self, *arguments: Any) -> None:
        """Raise RuntimeError: it needs a program of others; use sim.moveToConfig or sim.ruckigPos."""
        raise RuntimeError(
            "sim.generateTimeOptimalTrajectory is not here: sim.moveToConfig and sim.ruckigPos move within limits"
        )

    def getConfigDistance(self, first: Any, second: Any, metric: Any = None, types: Any = None) -> float:
        """Return the distance of two configurations: the root of the squares of their differences, each times its
        factor of ``metric``; ``types``: 2 for cyclic numbers."""
        weights, kinds = _filled(metric, first, 1.0), _filled(types, first, 0)
        total = 0.0
        for a, b, weight, kind in zip(first, second, weights, kinds, strict=True):
            way = b - a
            total += (weight * (math.remainder(way, math.tau) if kind == 2 else way)) ** 2
        return float(total**0.5)

    def _instead(self, function: str, why: str) -> None:
        self.addLog(self.verbosity_scriptwarnings | self.verbosity_once, f"sim.{function}: {why}")


def _filled(values: Any, like: Any, default: float) -> list[float]:
    return list(values) if isinstance(values, list | tuple) and values else [default] * len(like)
