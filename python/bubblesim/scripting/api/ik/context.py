# SPDX-License-Identifier: BSD-3-Clause
"""Common parts of the functions of simIK."""

from __future__ import annotations

from typing import Any

from bubblesim.scene_state.object_tree import ObjectTree
from bubblesim.scripting.api.ik.environment import Environment, Group, IkObject
from bubblesim.scripting.api.ik.solver import Solver
from bubblesim.scripting.caller import Caller

_MOST = 1000


class IkContext:
    """The environments of one caller, by handle."""

    def __init__(self, runner: Any, caller: Caller) -> None:
        """Bind the functions to one script."""
        self._caller = caller
        self._simulation = runner.simulation
        self._world = self._simulation.world
        self._tree = ObjectTree(self._world, caller.shared.dummies, caller.shared.edits)
        self._environments: dict[int, tuple[Environment, Solver]] = {}
        self._created = 0

    def _add_environment(self, environment: Environment) -> int:
        if len(self._environments) >= _MOST:
            raise ValueError(f"a script has at most {_MOST} environments: erase some")
        self._created += 1
        self._environments[self._created] = environment, Solver(environment)
        return self._created

    def _pair(self, handle: int) -> tuple[Environment, Solver]:
        if handle not in self._environments:
            raise LookupError(f"there is no environment {handle}")
        return self._environments[handle]

    def _environment(self, handle: int) -> Environment:
        return self._pair(handle)[0]

    def _solver(self, handle: int) -> Solver:
        return self._pair(handle)[1]

    def _group(self, environment: int, group: int) -> Group:
        return self._environment(environment).group(group)

    def _joint(self, environment: int, joint: int) -> IkObject:
        return self._environment(environment).joint(joint)
