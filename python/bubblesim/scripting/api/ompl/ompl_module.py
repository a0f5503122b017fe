# SPDX-License-Identifier: BSD-3-Clause
"""The module `simOMPL` of one child script."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import Any

from bubblesim.scripting.api.functions import script_module
from bubblesim.scripting.api.kinds import Integers, Numbers
from bubblesim.scripting.api.named_constants import Names
from bubblesim.scripting.api.ompl.spaces import Space
from bubblesim.scripting.api.ompl.tasks import Task
from bubblesim.scripting.api.sim.sim_module import SimApi
from bubblesim.scripting.caller import Caller

_ALGORITHMS = ("RRT", "RRTConnect", "RRTstar", "PRM", "PRMstar", "BKPIECE1", "KPIECE1", "LBKPIECE1", "FMT", "BFMT")
_MOST = 1000  # tasks and spaces of a script


@script_module("simOMPL")
class SimOmpl:
    """Motion planning on OMPL: `scripts/setup --with planning` installs it. A task has state spaces, a start and a
    goal; its states are lists of the numbers of all spaces. Whether a state is valid is found out in the scene, where
    the objects are moved and put back: collision pairs, and a callback. The simulation waits, at most a minute."""

    StateSpaceType = Names(
        position2d=1, pose2d=2, position3d=3, pose3d=4, joint_position=5, dubins=6, cyclic_joint_position=7
    )
    Algorithm = Names({name: number for number, name in enumerate(_ALGORITHMS, 1)})
    handle_all = -2

    def __init__(self, runner: Any, caller: Caller) -> None:
        """Bind the functions to one script."""
        self._caller = caller
        self._sim: Any = SimApi(runner, caller)
        self._tasks: dict[int, Task] = {}
        self._spaces: dict[int, Space] = {}
        self._made = 0

    def createTask(self, name: str) -> int:
        """Create a task; return its handle."""
        return self._keep(self._tasks, Task(name))

    def destroyTask(self, task: int) -> None:
        """Forget a task."""
        self._task(task).forget()
        del self._tasks[task]

    def createStateSpace(
        self,
        name: str,
        kind: int,
        handle: int,
        lower: Numbers,
        upper: Numbers,
        use_for_projection: int = 0,
        weight: float = 1.0,
        frame: int = -1,
        turning_radius: float = 0.05,
        is_symmetric: bool = False,
    ) -> int:
        """Create a state space, simOMPL.StateSpaceType.position2d, pose2d, position3d, pose3d, joint_position, dubins
        or cyclic_joint_position, of an object or joint; return its handle.

        ``lower`` and ``upper`` bound the position, in m or rad; ``weight`` is that of its distances. Positions are
        relative to ``frame``, -1 for the world. States are x, y; x, y and the angle about z; x, y, z; pose; position.
        """
        self._sim.getObjectType(handle)  # raises
        space = Space(kind, handle, lower, upper, weight, frame, turning_radius, is_symmetric)
        return self._keep(self._spaces, space)

    def destroyStateSpace(self, space: int) -> None:
        """Forget a state space."""
        self._space(space)
        del self._spaces[space]

    def setStateSpace(self, task: int, spaces: Integers) -> None:
        """Set the state spaces of a task."""
        self._task(task).spaces = [self._space(space) for space in spaces]

    def setAlgorithm(self, task: int, algorithm: int) -> None:
        """Set the planner, simOMPL.Algorithm.RRTConnect, PRM ..."""
        names = {number: name for name, number in self.Algorithm.items()}
        if algorithm not in names:
            raise ValueError(f"{algorithm} is not an algorithm: use simOMPL.Algorithm.{', '.join(_ALGORITHMS)}")
        self._task(task).algorithm = names[algorithm]

    def setCollisionPairs(self, task: int, pairs: Integers) -> None:
        """Set what must not collide: two entities each, objects, collections or sim.handle_all."""
        if len(pairs) % 2:
            raise ValueError(f"collision pairs are two entities each, found {len(pairs)}")
        self._task(task).pairs = pairs

    def setStartState(self, task: int, state: Numbers) -> None:
        """Set the state where the path begins, after the state space."""
        found = self._task(task)
        found.start = found.check(state, "start")

    def setGoalState(self, task: int, state: Numbers) -> None:
        """Set the state where the path ends, after the state space."""
        found = self._task(task)
        found.goals = [found.check(state, "goal")]

    def addGoalState(self, task: int, state: Numbers) -> None:
        """Add another state where the path may end; they are tried in turn."""
        found = self._task(task)
        found.goals.append(found.check(state, "goal"))

    def setGoalStates(self, task: int, states: Any) -> None:
        """Set the states where the path may end."""
        found = self._task(task)
        found.goals = [found.check(state, "goal") for state in states]

    def setStateValidationCallback(self, task: int, callback: Any) -> None:
        """Ask a function of the script whether a state is valid, beside the collision pairs."""
        if self._caller.is_remote:
            raise TypeError("a remote client cannot check states: use simOMPL.setCollisionPairs")
        call = callback if callable(callback) else self._caller.answering_callback(callback, lambda result: None)
        self._task(task).callback = lambda state: bool(call(state))

    def setStateValidityCheckingResolution(self, task: int, resolution: float) -> None:
        """Set the distance of the states that are checked on a line, as a part of the space's extent; 0.01 at first."""
        if not 0 < resolution <= 1:
            raise ValueError(f"the resolution is a part of the space's extent, from 0 to 1, found {resolution:g}")
        self._task(task).resolution = resolution

    def setVerboseLevel(self, task: int, level: int) -> None:
        """Accept how much OMPL writes; it writes nothing."""
        self._task(task)

    def setup(self, task: int) -> None:
        """Return at once: a task is prepared when it is solved."""
        self._task(task)

    def solve(self, task: int, max_time: float = -1.0) -> bool:
        """Search a path, at most for a time in s; return whether there is one."""
        found = self._task(task)
        with self._put_back(found):
            return found.solve(lambda state: self._is_valid(found, state), max_time)

    def simplifyPath(self, task: int, max_time: float = -1.0) -> None:
        """Shorten the path that was found."""
        found = self._task(task)
        with self._put_back(found):
            found.simplify(max_time)

    def interpolatePath(self, task: int, state_count: int = 0) -> None:
        """Give the path that was found this number of states or more; 0 for as many as the resolution asks for."""
        self._task(task).interpolate(state_count)

    def getPath(self, task: int) -> list[float]:
        """Return the numbers of all states of the path, one state after the other; empty without a path."""
        return [number for state in self._task(task).path for number in state]

    def getReversedPath(self, task: int, path: Numbers) -> list[float]:
        """Return the states of a path in reverse order."""
        size = self._task(task).dimension
        return [number for i in range(len(path) // size - 1, -1, -1) for number in path[i * size : (i + 1) * size]]

    def getPathStateCount(self, task: int, path: Numbers) -> int:
        """Return how many states a path has."""
        return len(path) // max(1, self._task(task).dimension)

    def getPathState(self, task: int, path: Numbers, index: int) -> list[float]:
        """Return a state of a path by its number: from 1 in Lua's manner."""
        size = self._task(task).dimension
        if not 1 <= index <= len(path) // max(1, size):
            raise IndexError(f"the path has {len(path) // max(1, size)} states, there is no number {index}")
        return path[(index - 1) * size : index * size]

    def compute(
        self, task: int, max_time: float = -1.0, max_simplification_time: float = -1.0, state_count: int = 0
    ) -> tuple[bool, list[float]]:
        """Search a path, shorten it and give it a number of states; return whether there is one, and its numbers."""
        if not self.solve(task, max_time):
            return False, []
        self.simplifyPath(task, max_simplification_time)
        self.interpolatePath(task, state_count)
        return True, self.getPath(task)

    def hasSolution(self, task: int) -> bool:
        """Return whether a path was found."""
        return bool(self._task(task).path)

    def hasExactSolution(self, task: int) -> bool:
        """Return whether a path to the goal was found."""
        return self._task(task).is_exact

    def hasApproximateSolution(self, task: int) -> bool:
        """Return False: paths that do not reach the goal are not kept."""
        self._task(task)
        return False

    def isStateValid(self, task: int, state: Numbers) -> bool:
        """Return whether a state collides with nothing, and the callback takes it."""
        found = self._task(task)
        with self._put_back(found):
            return self._is_valid(found, found.check(state, "state"))

    def readState(self, task: int) -> list[float]:
        """Return the state of the scene."""
        return [number for space in self._task(task).spaces for number in space.present(self._sim)]

    def writeState(self, task: int, state: Numbers) -> None:
        """Move the objects and joints of a task's spaces to a state."""
        found = self._task(task)
        self._place(found, found.check(state, "state"))

    def _is_valid(self, task: Task, state: list[float]) -> bool:
        self._place(task, state)
        pairs = zip(task.pairs[::2], task.pairs[1::2], strict=True)
        if any(self._sim.checkCollision(first, second)[0] for first, second in pairs):
            return False
        return task.callback is None or task.callback(state)

    def _place(self, task: Task, state: list[float]) -> None:
        for space, part in zip(task.spaces, task.parts(state), strict=True):
            space.place(self._sim, part)

    @contextlib.contextmanager
    def _put_back(self, task: Task) -> Iterator[None]:
        """Move the objects back to where they were; joints keep their targets."""
        sim = self._sim
        joints = [space.handle for space in task.spaces if sim.getObjectType(space.handle) == sim.object_joint_type]
        targets = [(joint, sim.getJointTargetPosition(joint)) for joint in joints]
        before = [space.present(sim) for space in task.spaces]
        try:
            yield
        finally:
            for space, part in zip(task.spaces, before, strict=True):
                space.place(sim, part)
            for joint, target in targets:
                sim.setJointTargetPosition(joint, target)

    def _keep(self, table: dict[int, Any], value: Any) -> int:
        if len(table) >= _MOST:
            raise ValueError(f"a script has at most {_MOST} tasks and state spaces: destroy some")
        self._made += 1
        table[self._made] = value
        return self._made

    def _task(self, handle: int) -> Task:
        if handle not in self._tasks:
            raise LookupError(f"there is no task {handle}")
        return self._tasks[handle]

    def _space(self, handle: int) -> Space:
        if handle not in self._spaces:
            raise LookupError(f"there is no state space {handle}")
        return self._spaces[handle]
