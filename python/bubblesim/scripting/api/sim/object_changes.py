# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that change objects: names, parents, colours, and whether physics moves them."""

from __future__ import annotations

import contextlib
from pathlib import Path

from bubblesim._core import StandIn, WrongObject, sensor_kind
from bubblesim.scene_state.compound_shapes import CompoundShape
from bubblesim.scene_state.scene_edits import Hold, relative
from bubblesim.scripting.api.checked_calls import refusal_warns
from bubblesim.scripting.api.kinds import Handle, Vector3
from bubblesim.scripting.api.sim.context import ApiContext
from bubblesim.scripting.threads import script_thread

_MOST_CHARACTERS = 255  # of a name


class ObjectChangeFunctions(ApiContext):
    """Changes of a stopped scene stay until it is closed. Names, parents and static flags that are changed during a run
    are restored when it ends. ROS topics and messages keep the names of the scene's file."""

    def setObjectAlias(self, handle: Handle, alias: str) -> None:
        """Name an object."""
        handle = self._resolve(handle)
        if not 0 < len(alias) <= _MOST_CHARACTERS or any(sign in alias for sign in "/[]{}*"):
            shown = alias[:_MOST_CHARACTERS]
            raise ValueError(
                f"'{shown}' is not a name: it must have 1 to {_MOST_CHARACTERS} characters, no / [ ] {{ }} *"
            )
        self._edits.begin_change()
        self._tree.set_name(handle, alias)

    def setObjectName(self, handle: Handle, name: str) -> None:
        """Name an object (old style)."""
        self.setObjectAlias(handle, name)

    @refusal_warns
    def setObjectParent(self, handle: Handle, parent: int, keep_in_place: bool = True) -> None:
        """Attach an object to another one or, with -1, to the world. ``keep_in_place``: its pose in the world stays,
        else its pose relative to the parent.

        A dummy moves with its parent. As in the original, a model moves along when its parent is set to a pose; physics
        moves it along if it is static (sim.shapeintparam_static), or if the parent is a force-torque sensor, which
        holds it. Its weight does not act on the parent. Parts of a model that physics holds elsewhere cannot be
        attached.
        """
        handle = self._resolve(handle)
        parent = parent if parent == self.handle_world else self._resolve(parent)
        if self._tree.parent(handle) == parent:
            return
        self._edits.begin_change()
        self._tree.set_parent(handle, parent, in_place=keep_in_place)
        if self._tree.kind(handle) in ("model", "link"):
            self._update_hold(self._tree.model(handle))

    @refusal_warns
    def setObjectColor(self, handle: Handle, index: int, component: int, colour: Vector3) -> bool:
        """Set a colour of a model, a link or a dummy: red, green, blue from 0 to 1. See setShapeColor."""
        self.setShapeColor(handle, None, component, colour)
        return True

    def getObjectColor(self, handle: Handle, index: int, component: int) -> list[float] | None:
        """Return a colour of a model, a link or a dummy; None (nil) if it has none. See getShapeColor."""
        return self._colour(self._resolve(handle), component)

    @refusal_warns
    def setShapeColor(self, handle: Handle, name: object, component: int, colour: Vector3) -> None:
        """Set the colour of all visuals of a model or link, which cameras see: red, green, blue from 0 to 1.

        ``component`` is sim.colorcomponent_ambient_diffuse; other components, and the ``name`` of a part of a shape,
        have no effect. The colour stays until the scene is closed.
        """
        handle = self._resolve(handle)
        if not self._tree.has_body(handle):
            self._tree.dummy(handle).colours[component] = colour
        elif component == self.colorcomponent_ambient_diffuse:
            self._edits.colours.set(self._simulation, handle, colour)
        else:
            self._simulation.color(handle)  # raises for objects without visuals

    def getShapeColor(self, handle: Handle, name: object, component: int) -> tuple[int, list[float]]:
        """Return 1 and the colour of the first visual of a model or link; 0 and black for components without effect."""
        colour = self._colour(self._resolve(handle), component)
        return (0, [0.0, 0.0, 0.0]) if colour is None else (1, colour)

    def isDynamicallyEnabled(self, handle: Handle) -> bool:
        """Return whether physics moves an object: the simulation is not stopped, and the model is not static."""
        handle = self._resolve(handle)
        if not self._tree.has_body(handle) or self._is_stopped():
            return False
        return not self._is_static(handle)

    @refusal_warns
    def resetDynamicObject(self, handle: Handle) -> None:
        """Set the velocity of a model or link to 0. A link that is the child of a joint keeps it: the mechanism that it
        is a part of would give it back."""
        handle = self._resolve(handle)
        if self._tree.kind(handle) == "link" and self._hangs_on_a_joint(handle):
            return
        self._world.set_state(handle, self._world.pose(handle), [0.0, 0.0, 0.0], [0.0, 0.0, 0.0])

    def _hangs_on_a_joint(self, link: int) -> bool:
        joints = self._world.parts(self._tree.model(link), "joint")
        return any(self._world.joint_links(joint)[1] == link for joint in joints)

    @refusal_warns
    def setShapeMass(self, handle: Handle, mass: float) -> None:
        """Set the mass, kg, of a link or of all links of a model; the inertia is scaled by the same factor.

        Masses of the scene's file are put back when the simulation is reset.
        """
        handle = self._resolve(handle)
        shape = self._edits.shapes.get(handle)
        if shape is None:
            self._world.set_mass(handle, mass)
            return
        if not mass > 0:
            raise ValueError(f"the mass of a shape must be positive, found {mass:g}")
        shape.mass = mass
        self._rebuild(handle)

    def getShapeMass(self, handle: Handle) -> float:
        """Return the mass, kg, of a link or of all links of a model."""
        handle = self._resolve(handle)
        shape = self._edits.shapes.get(handle)
        return float(self._world.mass(handle)) if shape is None else shape.mass

    def _colour(self, handle: int, component: int) -> list[float] | None:
        if not self._tree.has_body(handle):
            return self._tree.dummy(handle).colours.get(component)
        colour = [float(part) for part in self._simulation.color(handle)]
        return colour if component == self.colorcomponent_ambient_diffuse else None

    def _is_static(self, handle: int) -> bool:
        return bool(self._world.is_static(handle)) or self._world.outermost_model_of(handle) in self._edits.static

    def _set_static(self, handle: int, static: bool) -> None:
        """Let physics move a model, or not."""
        model = int(self._world.outermost_model_of(handle))
        if static == self._is_static(model):
            return
        if self._world.is_static(model) and model not in self._edits.shapes:
            path = self._tree.short_path(model)
            raise WrongObject(f"{path} is static in the scene's file: physics cannot move it")
        self._edits.begin_change()
        (self._edits.static.add if static else self._edits.static.discard)(model)
        if shape := self._edits.shapes.get(model):
            shape.static = static
            self._rebuild(model)
        self._update_hold(self._resolve(self._shown(model)))

    def _is_respondable(self, handle: int) -> bool:
        shape = self._edits.shapes.get(int(self._world.outermost_model_of(handle)))
        return shape is None or shape.respondable

    def _set_respondable(self, handle: int, respondable: bool) -> None:
        """Let other shapes collide with a created shape, or not."""
        model = int(self._world.outermost_model_of(handle))
        if respondable == self._is_respondable(model):
            return
        if model not in self._edits.shapes:
            path = self._tree.short_path(model)
            raise WrongObject(f"{path} collides as the scene's file defines; only created shapes can be changed")
        self._edits.shapes[model].respondable = respondable
        self._rebuild(model)

    def _update_hold(self, model: int) -> None:
        """Hold a model that is static, or attached to a force-torque sensor, in the frame of what it is attached to."""
        self._edits.holds.pop(model, None)
        if self._world.is_static(model):
            return
        frame = self._tree.frame_above(self._tree.object_of(model))
        if model in self._edits.static or (frame >= 0 and self._is_force_sensor(frame)):
            pose = [float(number) for number in self._world.pose(model)]
            self._edits.holds[model] = Hold(frame, relative(self._world, pose, frame))

    def _is_force_sensor(self, handle: int) -> bool:
        is_sensor = self._tree.kind(handle) == "sensor"
        return is_sensor and sensor_kind(self._simulation, handle) == "force-torque sensor"

    def _rebuild(self, model: int) -> None:
        """Build a created shape anew with its new properties; callers keep its handle."""
        edits = self._edits
        shape, pose = edits.shapes[model], [float(number) for number in self._world.pose(model)]
        linear, angular = self._world.velocity(model)
        known, name, parent = self._shown(model), self._tree.name(model), self._tree.parent(model)
        colour, static, placed = self._simulation.color(model), model in edits.static, edits.placed.get(model)
        # The parts of a group have colours of their own.
        is_painted = not isinstance(shape, CompoundShape) or any(edits.colours.of(self._world, model))
        attached = self._tree.children(model)
        attached = [child for child in attached if self._tree.is_created_dummy(child) or child in edits.parents]
        for child in attached:
            self._world.set_parent(child, self.handle_world)
        data = {key: value for key, value in self._caller.shared.custom_data.items() if key[0] == model}
        self._remove_model(model)
        anew = self._add_model(shape.sdf(), shape.name)
        edits.replaced[known] = anew
        edits.shapes[anew] = shape
        if self._world.is_static(anew):
            self._world.set_pose(anew, pose)
        else:
            self._world.set_state(anew, pose, list(linear), list(angular))
        if is_painted:
            self._edits.colours.set(self._simulation, anew, colour)
        if self._tree.name(anew) != name:
            self._tree.set_name(anew, name)
        if parent >= 0:
            self._tree.set_parent(anew, parent, in_place=True)
        if static:
            edits.static.add(anew)
        if placed:
            edits.placed[anew] = placed
        for child in attached:
            self._tree.set_parent(child, anew, in_place=True)
            if self._tree.has_body(child):
                self._update_hold(child)
        for (_, tag), value in data.items():
            self._caller.shared.custom_data[anew, tag] = value
        self._update_hold(anew)

    def _add_model(self, text: str, name: str) -> int:
        """Add a model from the text of its file; a name that is taken gets a number."""
        with self._stand_in():
            model = int(self._simulation.add_model(text, name=self._free_name(name)).handle)
        self._edits.sources[model] = text
        return model

    def _add_foreign_models(self, file: Path) -> int:
        """Add what a file of CoppeliaSim has, and return the object at its top: the base of a model, if it has one."""
        before = set(self._world.children(-1))
        with self._stand_in():
            models = [int(model.handle) for model in self._simulation.add_foreign_models(str(file))]
        tops = [int(handle) for handle in self._world.children(-1) if handle not in before]
        base = next((handle for handle in tops if self._world.is_model_base(handle)), tops[0])
        self._edits.foreign[base] = models
        return base

    def _free_name(self, name: str) -> str:
        """Return the name of a model, or the name with the next free number."""
        taken = {str(self._world.name(handle)) for handle in self._world.models}
        number = 1
        while (free := name if number == 1 else f"{name}_{number}") in taken:
            number += 1
        return free

    def _remove_model(self, handle: int) -> None:
        with self._stand_in():
            if scripts := self._caller.shared.scripts:
                scripts.remove_model(handle)
            else:
                self._simulation.remove_model(handle)

    def _stand_in(self) -> contextlib.AbstractContextManager[object]:
        """Return a context in which a script's thread, whose turn it is, changes models like the simulation's."""
        return StandIn(self._simulation) if script_thread.current() else contextlib.nullcontext()
