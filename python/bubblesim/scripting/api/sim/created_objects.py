# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that create and remove objects."""

from __future__ import annotations

from copy import copy as copied
from typing import Any

from bubblesim._core import WrongObject, add_copy, copy_model
from bubblesim.scene_state.created_shapes import CreatedShape
from bubblesim.scene_state.primitive_shapes import PrimitiveShape
from bubblesim.scene_state.text_shapes import text_sdf
from bubblesim.scripting.api.checked_calls import refusal_warns
from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.kinds import Handle, Integers, Numbers, Vector3
from bubblesim.scripting.api.sim.logs import LogFunctions
from bubblesim.scripting.api.sim.object_changes import ObjectChangeFunctions

_NO_COLOUR: list[float] = []
_RESPONDABLE, _STATIC = 8, 16  # options of createPureShape


class CreatedObjectFunctions(ObjectChangeFunctions, LogFunctions):
    """Dummies are frames without a body; they move with the object that they are attached to. A dummy that is created
    while the simulation runs ends with the run, others stay. A created shape is a model of one link, and stays until it
    is removed or the scene is closed."""

    def createDummy(self, size: float, colour: Numbers = _NO_COLOUR) -> int:
        """Create a dummy at the origin and return its handle; ``size`` in metres and the colour are for drawings."""
        dummy = self._caller.shared.dummies.create(self._world, "Dummy", size, temporary=not self._is_stopped())
        if colour:
            dummy.colours[self.colorcomponent_ambient_diffuse] = list(colour[:3])
        return dummy.handle

    @differs("it makes joints that physics moves, too; here all links of a mechanism are built at once, from files")
    def createJoint(
        self, joint_type: int, mode: int = 0, options: int = 0, sizes: Any = None, colour: Any = None, more: Any = None
    ) -> int:
        """Create a joint at the origin and return its handle; ``sizes``, its length and diameter, are for drawings.

        It has no physics: setJointPosition moves all that is below it in the tree, about or along its z axis, so a
        ``mode`` of sim.jointmode_dynamic is taken for kinematic, with a warning. As in the original, a revolute joint
        turns without limits, a prismatic one moves from -0.5 m to 0.5 m: see setJointInterval. It ends like a dummy."""
        types = {
            self.joint_revolute: "revolute",
            self.joint_prismatic: "prismatic",
            self.joint_spherical: "ball",
        }
        if joint_type not in types:
            raise ValueError(
                f"{joint_type} is not a type of joints: use sim.joint_revolute, joint_prismatic or joint_spherical"
            )
        if mode == self.jointmode_dynamic:
            level = self.verbosity_scriptwarnings | self.verbosity_once
            self.addLog(level, "sim.createJoint: the joint is kinematic: those that physics moves are made in files")
        size = float(sizes[0]) if isinstance(sizes, list | tuple) and sizes else 0.1
        name = types[joint_type].capitalize() + "_joint" if joint_type != self.joint_spherical else "Spherical_joint"
        made = self._caller.shared.dummies.create(
            self._world, name, size, temporary=not self._is_stopped(), joint=types[joint_type]
        )
        if joint_type == self.joint_prismatic:
            self._world.set_joint_limits(made.handle, -0.5, 0.5)
        return made.handle

    def getDummySize(self, dummy: Handle) -> float:
        """Return the size of a dummy in metres."""
        return self._tree.dummy(self._resolve(dummy)).size

    def createPrimitiveShape(self, primitive_type: int, sizes: Vector3, options: int = 0) -> int:
        """Create a shape at the origin and return its handle; not in sysCall_sensing.

        Types: sim.primitiveshape_cuboid, spheroid, cylinder, cone, capsule, plane and disc; ``sizes`` are full lengths
        along x, y, z in m. ``options`` are for drawings. As in the original, the shape is static and not respondable
        until sim.setObjectInt32Param sets sim.shapeintparam_static to 0 and sim.shapeintparam_respondable to 1. Its
        mass is that of water."""
        return self._add_shape(PrimitiveShape(primitive_type, list(sizes)))

    def createPureShape(
        self, primitive_type: int, options: int, sizes: Vector3, mass: float, precision: object = None
    ) -> int:
        """Create a shape at the origin and return its handle (old name). Types: 0 cuboid, 1 sphere, 2 cylinder, 3 cone.
        ``options``: 8 respondable, 16 static; ``mass`` in kg."""
        kinds = (
            self.primitiveshape_cuboid,
            self.primitiveshape_spheroid,
            self.primitiveshape_cylinder,
            self.primitiveshape_cone,
        )
        if not 0 <= primitive_type < len(kinds):
            raise ValueError(
                f"{primitive_type} is not a type of createPureShape: 0 to 3, cuboid, sphere, cylinder, cone"
            )
        if not mass > 0:
            raise ValueError(f"the mass of a shape must be positive, found {mass:g}")
        flags = {"static": bool(options & _STATIC), "respondable": bool(options & _RESPONDABLE)}
        return self._add_shape(PrimitiveShape(kinds[primitive_type], list(sizes), mass, **flags))

    def generateTextShape(
        self, text: str, colour: Any = None, height: float = 0.1, centred: bool = False, alphabet: Any = None
    ) -> int:
        """Create a line of words and return its handle; not in sysCall_sensing.

        It lies along x, its letters up along y, with capital letters of a ``height`` in m, and collides with nothing.
        It stays until it is removed or the scene is closed."""
        shades = [float(part) for part in colour] if isinstance(colour, list | tuple) else [1.0, 1.0, 1.0]
        return self._tree.object_of(self._add_model(text_sdf(text, shades[:3], height, centred=centred), "Text"))

    @refusal_warns
    def removeObjects(self, handles: Integers, delayed: bool = False) -> int:
        """Remove dummies and whole models; return their number. ``delayed`` has no effect.

        In sysCall_sensing only dummies can be removed.
        """
        resolved = [self._resolve(handle) for handle in handles]
        for handle in resolved:
            self._check_removable(handle)
        for handle in resolved:
            if not self._tree.contains(handle):
                continue  # it was below another one
            if self._tree.is_created_dummy(handle):
                self._caller.shared.dummies.remove(self._world, handle)
            else:
                for model in self._edits.foreign.pop(handle, [self._tree.model(handle)]):
                    self._remove_model(model)
        return len(handles)

    @refusal_warns
    def removeObject(self, handle: Handle) -> int:
        """Remove a dummy or a whole model (old name)."""
        return self.removeObjects([handle])

    @refusal_warns
    def removeModel(self, handle: Handle, delayed: bool = False) -> int:
        """Remove a model with all its objects, or a dummy; return 1.

        Of a scene of CoppeliaSim, what is below an object in the tree is removed with it, also what nothing connects.
        """
        base = self._resolve(handle)
        models = self._models_below(base)
        if base in self._edits.foreign or len(models) < 2:
            return self.removeObjects([handle])
        roots = self._tree.children(self.handle_world)
        others = {each for root in roots for each in self._tree.with_all_below(root)}
        others -= set(self._tree.with_all_below(base))
        for model in models:
            if beside := others.intersection(self._world.parts(model, "link")):
                path, other = self._tree.short_path(base), self._tree.short_path(min(beside))
                raise WrongObject(f"{path} cannot be removed on its own: it is connected with {other}")
        for model in models:
            self._remove_model(model)
        return 1

    def _models_below(self, base: int) -> list[int]:
        """Return what moves together, of an object and all below it."""
        models = (self._tree.model(each) for each in self._tree.with_all_below(base) if self._tree.has_body(each))
        return [model for model in dict.fromkeys(models) if model >= 0]

    def copyPasteObjects(self, handles: Integers, options: int = 0) -> list[int]:
        """Copy dummies and whole models where they are; return the handles of the copies.

        A copy is below the copy of its parent, or else at the top. ``options`` 1: with a base of a model, all that is
        below it is copied too. Copies of models stay until they are removed or the scene is closed.
        """
        wanted = [self._resolve(handle) for handle in handles]
        whole = [handle for handle in wanted if options & 1 and self._world.is_model_base(handle)]
        below = [each for handle in whole for each in self._tree.with_all_below(handle) if self._is_copied_alone(each)]
        for handle in wanted:
            if not self._is_copied_alone(handle):
                path = self._tree.short_path(handle)
                raise ValueError(f"{path} cannot be copied on its own: copy the whole model, or a dummy")
        copies = {handle: self._copy(handle) for handle in dict.fromkeys([*wanted, *below])}
        for handle, copy in copies.items():
            if (parent := copies.get(self._tree.parent(handle))) is not None:
                self._tree.set_parent(copy, parent, in_place=True)
        return [copies[handle] for handle in wanted]

    def _is_copied_alone(self, handle: int) -> bool:
        model = self._tree.model(handle)
        return self._tree.kind(handle) == "dummy" if model < 0 else self._tree.object_of(model) == handle

    def _copy(self, handle: int) -> int:
        if not self._tree.has_body(handle):
            known = self._tree.dummy(handle)
            copy = self.createDummy(known.size)
            self._tree.dummy(copy).colours.update(known.colours)
            self._tree.set_name(copy, self._tree.name(handle))
            self._tree.set_pose(copy, self._tree.pose(handle))
            return copy
        model = self._tree.model(handle)
        taken = copy_model(self._simulation, model)
        with self._stand_in():
            made = add_copy(self._simulation, taken, self._free_name(taken.name), taken.position, taken.orientation)
        edits = self._edits
        if model in edits.sources:
            edits.sources[made] = edits.sources[model]
        else:
            edits.originals[made] = edits.originals.get(model, str(self._world.name(model)))
        if model in edits.shapes:
            edits.shapes[made] = copied(edits.shapes[model])
        if model in edits.static:
            edits.static.add(made)
        edits.colours.give(self._simulation, made, edits.colours.of(self._world, model))
        edits.numbers.give(self._world, made, edits.numbers.of(self._world, model))
        self._update_hold(made)
        return self._tree.object_of(made)

    def _add_shape(self, shape: CreatedShape) -> int:
        model = self._add_model(shape.sdf(), shape.name)
        self._edits.shapes[model] = shape
        self._tree.set_pose(model, self._tree.pose(model))  # where it is after a stop
        if shape.static:
            self._edits.static.add(model)
        self._update_hold(model)
        return model

    def _check_removable(self, handle: int) -> None:
        if self._tree.is_created_dummy(handle) or handle in self._edits.foreign:
            return
        model = self._tree.model(handle)
        if model < 0 or self._tree.object_of(model) != handle:
            path = self._tree.short_path(handle)
            raise WrongObject(f"{path} cannot be removed on its own: remove the whole model, or a dummy")
