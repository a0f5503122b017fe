# SPDX-License-Identifier: BSD-3-Clause
"""One task of simOMPL: its settings, the search, and the path that was found."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

from bubblesim.scripting.api.ompl.spaces import Space, ompl

Validity = Callable[[list[float]], bool]
_LONGEST = 60.0  # s, of a search: the simulation waits for it
_RESOLUTION = 0.01  # of the space's extent, as OMPL's own


@dataclass
class Task:
    """A search between two states."""

    name: str
    spaces: list[Space] = field(default_factory=list)
    algorithm: str = "RRTConnect"
    pairs: list[int] = field(default_factory=list)
    """Entities that must not collide: first and second of each pair."""
    start: list[float] = field(default_factory=list)
    goals: list[list[float]] = field(default_factory=list)
    callback: Validity | None = None
    resolution: float = _RESOLUTION
    is_exact: bool = False
    path: list[list[float]] = field(default_factory=list)
    """The states of the last path; empty without one."""
    _setup: Any = None

    @property
    def dimension(self) -> int:
        """How many numbers a state has."""
        return sum(space.dimension for space in self.spaces)

    def check(self, state: Sequence[float], what: str) -> list[float]:
        """Return a state; raise ValueError if it has another number of numbers."""
        if len(state) != self.dimension:
            raise ValueError(f"the {what} of '{self.name}' must have {self.dimension} numbers, found {len(state)}")
        return list(state)

    def parts(self, state: Sequence[float]) -> list[list[float]]:
        """Return the states of the spaces."""
        parts, begin = [], 0
        for space in self.spaces:
            parts.append(list(state[begin : begin + space.dimension]))
            begin += space.dimension
        return parts

    def solve(self, valid: Validity, seconds: float) -> bool:
        """Search a path; return whether there is one.

        :param valid: whether a state is free; its first error ends the search, and is raised.
        :param seconds: the longest time; none or a negative one is a minute.
        """
        if not self.spaces or not self.start or not self.goals:
            raise ValueError(f"the task '{self.name}' needs a state space, a start and a goal before it is solved")
        self.path, self.is_exact = [], False
        limit = min(seconds, _LONGEST) if seconds > 0 else _LONGEST
        begin = time.monotonic()
        for number, goal in enumerate(self.goals):
            left = (limit - (time.monotonic() - begin)) / (len(self.goals) - number)
            if left > 0 and self._solve_one(goal, valid, left):
                return True
        return False

    def simplify(self, seconds: float) -> None:
        """Shorten the path."""
        self._solved().simplifySolution(*([min(seconds, _LONGEST)] if seconds > 0 else []))
        self._take_path()

    def interpolate(self, count: int) -> None:
        """Give the path this number of states or more; 0 for as many as the resolution asks for."""
        path = self._solved().getSolutionPath()
        if count > 0:
            path.interpolate(count)
        else:
            path.interpolate()
        self._take_path()

    def forget(self) -> None:
        """Release OMPL's objects."""
        self._setup = None

    def _solved(self) -> Any:
        if self._setup is None or not self.path:
            raise RuntimeError(f"the task '{self.name}' has no path: call simOMPL.solve first")
        return self._setup

    def _solve_one(self, goal: list[float], valid: Validity, seconds: float) -> bool:
        base, geometric = ompl("base"), ompl("geometric")
        ompl("util").noOutputHandler()
        compound = base.CompoundStateSpace()
        for space in self.spaces:
            compound.addSubspace(space.make(), space.weight)
        setup = geometric.SimpleSetup(compound)
        errors: list[BaseException] = []

        def is_valid(state: Any) -> bool:
            if errors:
                return False
            try:
                return valid(self._values(state))
            except BaseException as error:  # OMPL must end first
                errors.append(error)
                return False

        setup.setStateValidityChecker(is_valid)
        about = setup.getSpaceInformation()
        about.setStateValidityCheckingResolution(self.resolution)
        setup.setStartAndGoalStates(self._state(compound, self.start), self._state(compound, goal))
        setup.setPlanner(getattr(geometric, self.algorithm)(about))
        # In slices, so that an error of the script does not wait for the end.
        begin = time.monotonic()
        while not errors and not setup.haveExactSolutionPath():
            left = seconds - (time.monotonic() - begin)
            if left <= 0:
                break
            setup.solve(min(left, 0.25))
        if errors:
            raise errors[0]
        if not setup.haveExactSolutionPath():
            return False
        self._setup, self.is_exact = setup, True
        self._take_path()
        return True

    def _state(self, compound: Any, values: Sequence[float]) -> Any:
        state = compound.allocState()
        for i, (space, part) in enumerate(zip(self.spaces, self.parts(values), strict=True)):
            space.write(state[i], part)
        return state

    def _values(self, state: Any) -> list[float]:
        return [value for i, space in enumerate(self.spaces) for value in space.read(state[i])]

    def _take_path(self) -> None:
        path = self._setup.getSolutionPath()
        self.path = [self._values(path.getState(i)) for i in range(path.getStateCount())]
