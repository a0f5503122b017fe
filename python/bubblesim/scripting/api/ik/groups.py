# SPDX-License-Identifier: BSD-3-Clause
"""`simIK` functions for groups and their elements."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from bubblesim.scripting.api.ik.context import IkContext
from bubblesim.scripting.api.ik.environment import WORLD, Element, Group
from bubblesim.scripting.api.ik.solver import FAIL, SUCCESS, manipulability
from bubblesim.scripting.api.kinds import Integers, Numbers

_MOST_ITERATIONS = 10_000


class GroupFunctions(IkContext):
    """A group has elements, tips that are to reach their target dummies, and is solved as a whole."""

    def createGroup(self, environment: int, name: str = "") -> int:
        """Create a group and return its handle."""
        return self._environment(environment).add_group(name).handle

    def eraseGroup(self, environment: int, group: int) -> None:
        """Remove a group."""
        self._group(environment, group)
        del self._environment(environment).groups[group]

    def getGroupHandle(self, environment: int, name: str) -> int:
        """Return the handle of the group with a name."""
        for each in self._environment(environment).groups.values():
            if each.name == name:
                return each.handle
        raise LookupError(f"the environment has no group '{name}'")

    def doesGroupExist(self, environment: int, name: str) -> bool:
        """Return whether there is a group with a name."""
        return any(each.name == name for each in self._environment(environment).groups.values())

    def getGroupFlags(self, environment: int, group: int) -> int:
        """Return the flags of a group, simIK.group_enabled for example."""
        return self._group(environment, group).flags

    def setGroupFlags(self, environment: int, group: int, flags: int) -> None:
        """Set the flags of a group."""
        self._group(environment, group).flags = flags

    def getGroupCalculation(self, environment: int, group: int) -> tuple[int, float, int]:
        """Return method, damping and number of iterations of a group."""
        found = self._group(environment, group)
        return found.method, found.damping, found.iterations

    def setGroupCalculation(
        self, environment: int, group: int, method: int, damping: float = 0.1, iterations: int = 3
    ) -> None:
        """Set the method, simIK.method_damped_least_squares for example, damping and iterations of a group."""
        if method not in range(4):
            raise ValueError(f"{method} is not a method: use simIK.method_pseudo_inverse, damped_least_squares ...")
        found = self._group(environment, group)
        found.method, found.damping = method, abs(damping)
        found.iterations = min(max(1, iterations), _MOST_ITERATIONS)

    def addElement(self, environment: int, group: int, tip: int) -> int:
        """Add an element for a tip and return its handle, the number of the element in the group."""
        self._environment(environment).at(tip)  # raises
        elements = self._group(environment, group).elements
        elements.append(Element(tip, WORLD))
        return len(elements) - 1

    def getElementBase(self, environment: int, group: int, element: int) -> tuple[int, int]:
        """Return the base of an element, and in whose axes its position is constrained (-1: the world's)."""
        found = self._element_at(environment, group, element)
        return found.base, found.constraint_base

    def setElementBase(
        self, environment: int, group: int, element: int, base: int, constraint_base: int = WORLD
    ) -> None:
        """Set the base of an element, above which no joint moves, and in whose axes its position is constrained."""
        found = self._element_at(environment, group, element)
        for each in (base, constraint_base):
            if each >= 0:
                self._environment(environment).at(each)  # raises
        found.base, found.constraint_base = base, constraint_base

    def getElementConstraints(self, environment: int, group: int, element: int) -> int:
        """Return the constraints of an element, simIK.constraint_pose for example."""
        return self._element_at(environment, group, element).constraints

    def setElementConstraints(self, environment: int, group: int, element: int, constraints: int) -> None:
        """Set the constraints of an element."""
        self._element_at(environment, group, element).constraints = constraints

    def getElementFlags(self, environment: int, group: int, element: int) -> int:
        """Return 1 if an element is enabled, else 0."""
        return int(self._element_at(environment, group, element).is_enabled)

    def setElementFlags(self, environment: int, group: int, element: int, flags: int) -> None:
        """Enable an element (1), or disable it."""
        self._element_at(environment, group, element).is_enabled = bool(flags & 1)

    def getElementPrecision(self, environment: int, group: int, element: int) -> list[float]:
        """Return the precision of an element: m and rad."""
        return list(self._element_at(environment, group, element).precision)

    def setElementPrecision(self, environment: int, group: int, element: int, precision: Numbers) -> None:
        """Set the precision of an element: m and rad."""
        if len(precision) != 2 or min(precision) < 0:
            raise ValueError(f"a precision has two numbers, m and rad, found {precision}")
        self._element_at(environment, group, element).precision = list(precision)

    def getElementWeights(self, environment: int, group: int, element: int) -> list[float]:
        """Return by how much position and orientation of an element count, 0 to 1."""
        return list(self._element_at(environment, group, element).weights)

    def setElementWeights(self, environment: int, group: int, element: int, weights: Numbers) -> None:
        """Set by how much position and orientation of an element count, 0 to 1."""
        if len(weights) < 2:
            raise ValueError(f"weights are two numbers, found {weights}")
        self._element_at(environment, group, element).weights = list(weights[:2])

    def handleGroup(self, environment: int, group: int, options: Any = None) -> tuple[int, int, list[float]]:
        """Carry out the iterations of a group; return simIK.result_success or result_fail, the reason, and what is
        left: m and rad. Options: ``syncWorlds`` takes positions of the scene before, and gives them afterwards."""
        return self.handleGroups(environment, [group], options)

    def handleGroups(self, environment: int, groups: Integers, options: Any = None) -> tuple[int, int, list[float]]:
        """Carry out the iterations of several groups, one after the other; see handleGroup."""
        chosen = [self._group(environment, group) for group in groups]
        wanted = options if isinstance(options, Mapping) else {}
        sync = bool(wanted.get("syncWorlds"))
        if sync:
            self._take_from_scene(environment)
        results = [self._solver(environment).handle(group) for group in chosen if group.flags & 1]
        if not results:
            return 0, 1, [0.0, 0.0]
        if sync:
            self._give_to_scene(environment)
        worst = [max(left[i] for _, _, left in results) for i in (0, 1)]
        failed = [reason for result, reason, _ in results if result != SUCCESS]
        if not failed:
            return SUCCESS, 0, worst
        return (FAIL if any(result == FAIL for result, _, _ in results) else 0), failed[0], worst

    def computeGroupJacobian(self, environment: int, group: int) -> tuple[list[float], list[float]]:
        """Return the Jacobian of a group, row by row, and the errors of its constraints."""
        error, jacobian, _, _ = self._solver(environment).errors(self._group(environment, group))
        return jacobian.ravel().tolist(), error.ravel().tolist()

    def computeJacobian(self, environment: int, first: Any, second: Any = None, *more: Any) -> Any:
        """Return the Jacobian of a group (environment, group), row by row, with its size [columns, rows] in
        getJacobian; or of the tip of a chain (environment, base, joint or tip, constraints)."""
        if second is None or isinstance(second, Mapping):
            return self.computeGroupJacobian(environment, int(first))
        tip = (
            int(more[0])
            if more and isinstance(more[0], int) and more[0] in self._environment(environment).objects
            else int(second)
        )
        group = Group(0, "")
        found = self._environment(environment)
        group.elements = [Element(tip, int(first))]
        before, found.at(tip).target = found.at(tip).target, tip
        try:
            error, jacobian, _, _ = self._solver(environment).errors(group)
        finally:
            found.at(tip).target = before
        return jacobian.ravel().tolist(), error.tolist()

    def getJacobian(self, environment: int, group: int) -> tuple[list[float], list[int]]:
        """Return the Jacobian of a group, column by column, and its size [columns, rows]."""
        _, jacobian, _, _ = self._solver(environment).errors(self._group(environment, group))
        return jacobian.T.ravel().tolist(), [jacobian.shape[1], jacobian.shape[0]]

    def getManipulability(self, environment: int, group: int) -> float:
        """Return Yoshikawa's measure of manipulability of a group."""
        _, jacobian, _, _ = self._solver(environment).errors(self._group(environment, group))
        return manipulability(np.asarray(jacobian))

    def _element_at(self, environment: int, group: int, element: int) -> Element:
        elements = self._group(environment, group).elements
        if not 0 <= element < len(elements):
            raise LookupError(f"the group has no element {element}")
        return elements[element]

    def _take_from_scene(self, environment: int) -> None:
        raise NotImplementedError

    def _give_to_scene(self, environment: int) -> None:
        raise NotImplementedError
