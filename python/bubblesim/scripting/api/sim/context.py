# SPDX-License-Identifier: BSD-3-Clause
"""Common parts of all groups of `sim` functions."""

from __future__ import annotations

from typing import Any

from bubblesim._core import RunState
from bubblesim.scene_state.handle_error import MAX_HANDLE, HandleError
from bubblesim.scene_state.object_tree import ObjectTree
from bubblesim.scripting.api.sim.constants import SimConstants
from bubblesim.scripting.caller import Caller


class ApiContext(SimConstants):
    """The simulation and the calling script."""

    def __init__(self, runner: Any, caller: Caller) -> None:
        """Bind the functions to one script."""
        self._runner = runner
        self._simulation = runner.simulation
        self._world = self._simulation.world
        self._caller = caller
        self._edits = caller.shared.edits
        self._motions: dict[int, Any] = {}
        """Trajectories that the caller has prepared, by handle,"""
        self._particles: dict[int, Any] = {}
        """its particles, and"""
        self._clouds: dict[int, list[list[float]]] = {}
        """the points of its clouds."""
        self._octrees: dict[int, Any] = {}
        """Size and voxels of its octrees."""
        self._tree = ObjectTree(self._world, caller.shared.dummies, self._edits)

    def _is_stopped(self) -> bool:
        return bool(self._runner.state == RunState.STOPPED)

    def _shown(self, handle: int) -> int:
        """Return the handle under which callers know an object."""
        return self._edits.known_handle(handle) if self._edits.replaced else handle

    def _sensor(self, handle: int) -> int:
        """Return the handle under which the simulation knows a sensor."""
        handle = self._resolve(handle)
        return self._edits.sensors.get(handle, handle)

    def _box_of(self, links: list[int], frame: int) -> tuple[list[float], list[float]] | None:
        """Return the lowest and the highest x, y and z (m), in the frame of an object, of what collides of some links;
        None without a shape of a finite size."""
        found = self._world.bounds(links, self._tree.pose(frame))
        return None if found is None else (list(found[0]), list(found[1]))

    def _resolve(self, handle: int) -> int:
        """Convert sim.handle_self and sim.handle_parent to the handle of an object."""
        if 0 <= handle <= MAX_HANDLE:
            return self._edits.replaced.get(handle, handle) if self._edits.replaced else handle
        if handle == self.handle_self:
            return self._caller.object_handle
        if handle == self.handle_parent:
            return self._tree.parent(self._caller.object_handle)
        raise HandleError(handle)
