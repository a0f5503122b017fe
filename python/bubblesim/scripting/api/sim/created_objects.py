# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that create, attach, name and remove objects."""

from __future__ import annotations

from bubblesim._core import RunState
from bubblesim.scripting.api.kinds import Handle, Integers, Numbers, Vector3
from bubblesim.scripting.api.sim.context import ApiContext
from bubblesim.scripting.dummies import FIRST_HANDLE, Dummy

_NO_COLOUR: list[float] = []


class CreatedObjectFunctions(ApiContext):
    """Dummies are frames without a body; they move with the object that they are attached to. A dummy that is created
    while the simulation runs ends with the run, others stay. Names, parents and colours of the scene's own objects are
    those of its file."""

    def createDummy(self, size: float, colour: Numbers = _NO_COLOUR) -> int:
        """Create a dummy at the origin and return its handle; ``size`` in metres and the colour are for drawings."""
        temporary = self._runner.state != RunState.STOPPED
        dummy = self._caller.shared.dummies.create("Dummy", size, temporary=temporary)
        if colour:
            dummy.colours[self.colorcomponent_ambient_diffuse] = list(colour[:3])
        return dummy.handle

    def getDummySize(self, dummy: Handle) -> float:
        """Return the size of a dummy in metres."""
        return self._tree.dummy(dummy).size

    def setObjectAlias(self, handle: Handle, alias: str) -> None:
        """Name a dummy; objects of the scene keep the names of its file."""
        if not alias or any(sign in alias for sign in "/[]{}*"):
            raise ValueError(f"'{alias}' is not a name: it must not be empty or contain / [ ] {{ }} *")
        self._require_dummy(handle, "the name").name = alias

    def setObjectName(self, handle: Handle, name: str) -> None:
        """Name a dummy (old style)."""
        self.setObjectAlias(handle, name)

    def setObjectParent(self, handle: Handle, parent: int, keep_in_place: bool = True) -> None:
        """Attach a dummy to an object or, with -1, to the world. ``keep_in_place``: its pose in the world stays, else
        its pose relative to the parent."""
        self._require_dummy(handle, "the parent")
        parent = parent if parent == self.handle_world else self._resolve(parent)
        self._tree.set_parent(handle, parent, in_place=keep_in_place)

    def removeObjects(self, handles: Integers, delayed: bool = False) -> int:
        """Remove dummies and whole models; return their number. ``delayed`` has no effect.

        In sysCall_actuation and sysCall_sensing only dummies can be removed.
        """
        for handle in handles:
            self._check_removable(handle)
        for handle in handles:
            if handle >= FIRST_HANDLE:
                self._caller.shared.dummies.remove(handle)
            elif self._tree.contains(handle):
                self._remove_model(handle)
        return len(handles)

    def removeObject(self, handle: Handle) -> int:
        """Remove a dummy or a whole model (old name)."""
        return self.removeObjects([handle])

    def removeModel(self, handle: Handle, delayed: bool = False) -> int:
        """Remove a model with all its objects, or a dummy; return 1."""
        return self.removeObjects([handle])

    def setObjectColor(self, handle: Handle, index: int, component: int, colour: Vector3) -> bool:
        """Set a colour of a dummy: red, green, blue from 0 to 1."""
        self._require_dummy(handle, "the colour").colours[component] = colour
        return True

    def getObjectColor(self, handle: Handle, index: int, component: int) -> list[float] | None:
        """Return a colour of a dummy; None (nil) if it has none."""
        return self._require_dummy(handle, "the colour").colours.get(component)

    def setShapeColor(self, handle: Handle, name: object, component: int, colour: Vector3) -> None:
        """Raise ValueError: the materials of a scene are those of its file."""
        self._require_dummy(handle, "the colour").colours[component] = colour

    def isDynamicallyEnabled(self, handle: Handle) -> bool:
        """Return whether physics moves an object: the simulation is not stopped, and the model is not static."""
        handle = self._resolve(handle)
        if self._tree.kind(handle) == "dummy" or self._runner.state == RunState.STOPPED:
            return False
        return not self._world.is_static(handle)

    def resetDynamicObject(self, handle: Handle) -> None:
        """Set the velocity of a model or link to 0."""
        handle = self._resolve(handle)
        self._world.set_state(handle, self._world.pose(handle), [0.0, 0.0, 0.0], [0.0, 0.0, 0.0])

    def _require_dummy(self, handle: int, what: str) -> Dummy:
        handle = self._resolve(handle)
        if self._tree.kind(handle) != "dummy":
            path = self._tree.short_path(handle)
            raise ValueError(f"{what} of {path} is that of the scene's file and cannot be changed while it is loaded")
        return self._tree.dummy(handle)

    def _check_removable(self, handle: int) -> None:
        handle = self._resolve(handle)
        if self._tree.kind(handle) == "dummy":
            return
        if self._tree.kind(handle) != "model" or self._tree.parent(handle) >= 0:
            path = self._tree.short_path(handle)
            raise ValueError(f"{path} cannot be removed on its own: remove the whole model, or a dummy")

    def _remove_model(self, handle: int) -> None:
        if scripts := self._caller.shared.scripts:
            scripts.remove_model(handle)
        else:
            self._simulation.remove_model(handle)
