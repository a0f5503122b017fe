# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for properties: values of objects and of the scene by their names, as CoppeliaSim has since 4.8."""

from __future__ import annotations

import contextlib
from typing import Any

from bubblesim.scripting.api.kinds import (
    INTEGER,
    NO_OPTIONS,
    Handle,
    Integers,
    Numbers,
    Options,
    Vector3,
    Vector4,
    Vector7,
)
from bubblesim.scripting.api.sim.constants import SimConstants as Sim
from bubblesim.scripting.api.sim.custom_data import CustomDataFunctions
from bubblesim.scripting.api.sim.object_properties import OF_OBJECTS
from bubblesim.scripting.api.sim.property_kinds import Property, type_name, type_of
from bubblesim.scripting.api.sim.scene_objects import SceneObject
from bubblesim.scripting.api.sim.scene_properties import OF_APP, OF_SCENE
from bubblesim.scripting.api.sim.signals import require_type

_NUMBERS = (int, float)
_PARENT = Sim.handle_parent


class PropertyFunctions(CustomDataFunctions):
    """Values by name: 'customData.NAME' of an object or the scene, 'signal.NAME' of the scene, and CoppeliaSim's own
    names. Of objects: alias, objectType, parent, children, modelBase, pose, position, quaternion, eulerAngles (relative
    to the parent), absPose, absPosition, absQuaternion, absEulerAngles, mass, dynamic, respondable, bbHSize,
    dynLinearVelocity, dynAngularVelocity, color.diffuse; jointType, jointMode, dynCtrlMode, cyclic, interval,
    jointPosition, jointVelocity, jointForce, targetPosition, targetVelocity, targetForce; resolution. Of the scene,
    sim.handle_scene: gravity, simulationTime, simulationState, timeStep, scenePath. The option ``noError`` returns None
    (nil) for a property that an object does not have."""

    def Object(self, target: Any) -> Any:  # the original's name
        """Return an object of the scene, by its path or handle, whose properties are attributes and whose functions are
        methods: ``joint.targetVelocity = 1``, ``joint.getPosition()``. Functions take it in place of a handle. sim.self
        is the script's own object, sim.scene the scene. For child scripts."""
        if self._caller.is_remote:
            raise RuntimeError("sim.Object is for child scripts: remote clients use handles and sim.getProperty")
        sim: Any = self
        handle = sim.getObject(target) if isinstance(target, str) else INTEGER.convert(target)
        if handle != self.handle_scene:
            self._tree.kind(self._resolve(handle))  # raises
        return SceneObject(self, handle)

    @property
    def self(self) -> SceneObject:
        """The script's own object."""
        return SceneObject(self, self._caller.object_handle)

    @property
    def scene(self) -> SceneObject:
        """The scene, with its properties."""
        return SceneObject(self, self.handle_scene)

    def getProperty(self, target: Handle, name: str, options: Options = NO_OPTIONS) -> Any:
        """Return a property of any kind."""
        return self._any_property(target, name, options)

    def setProperty(self, target: Handle, name: str, value: Any, options: Options = NO_OPTIONS) -> None:
        """Set a property of any kind."""
        kind = dict if isinstance(value, dict | list | tuple) else type(value)
        self._set_property(kind, target, name, value)

    def getPropertyName(self, target: Handle, index: int, options: Options = NO_OPTIONS) -> tuple[str, str] | None:
        """Return the name of the property with an index from 0, and ''; None (nil) behind the last one."""
        names = sorted(self._properties(target))
        return (names[index], "") if 0 <= index < len(names) else None

    def getPropertyInfo(self, target: Handle, name: str, options: Options = NO_OPTIONS) -> tuple[int, int, str] | None:
        """Return the type of a property, sim.propertytype_float for example, flags, sim.propertyinfo_notwritable for
        example, and ''; None (nil) if there is none."""
        found = self._property(target, name)
        if found is None:
            value = self._any_property(target, name, {"noError": True})
            return None if value is None else (type_of(name, value), self.propertyinfo_removable, "")
        return type_of(name, found.get(self, target)), 0 if found.set else self.propertyinfo_notwritable, ""

    def getPropertyTypeString(self, kind: int, dotted: bool = False) -> str:
        """Return the name of a type of properties, 'float' for example."""
        return type_name(kind)

    def getProperties(self, target: Handle, options: Options = NO_OPTIONS) -> dict[str, Any]:
        """Return all properties of an object or the scene, by name, that can be read."""
        found = {}
        for name, each in self._properties(target).items():
            with contextlib.suppress(ValueError, LookupError, RuntimeError):
                found[name] = each.get(self, target)
        return found

    def setProperties(self, target: Handle, values: Options) -> None:
        """Set several properties by name."""
        for name, value in values.items():
            self.setProperty(target, name, value)

    def getPropertiesInfos(self, target: Handle, options: Options = NO_OPTIONS) -> dict[str, Any]:
        """Return ``type`` and ``flags`` of all properties that can be read, by name; see getPropertyInfo."""
        flags = {
            name: 0 if each.set else self.propertyinfo_notwritable for name, each in self._properties(target).items()
        }
        values = self.getProperties(target)
        return {name: {"type": type_of(name, value), "flags": flags[name]} for name, value in values.items()}

    def getVector2Property(self, target: Handle, name: str, options: Options = NO_OPTIONS) -> Any:
        """Return two numbers."""
        return self._any_property(target, name, options)

    def setVector2Property(self, target: Handle, name: str, value: Numbers) -> None:
        """Set two numbers."""
        self._set_property(list, target, name, value)

    def getIntArray2Property(self, target: Handle, name: str, options: Options = NO_OPTIONS) -> Any:
        """Return two integers."""
        return self._any_property(target, name, options)

    def setIntArray2Property(self, target: Handle, name: str, value: Integers) -> None:
        """Set two integers."""
        self._set_property(list, target, name, value)

    def getStringArrayProperty(self, target: Handle, name: str, options: Options = NO_OPTIONS) -> Any:
        """Return a list of strings."""
        return self._any_property(target, name, options)

    def setStringArrayProperty(self, target: Handle, name: str, value: Any) -> None:
        """Set a list of strings."""
        self._set_property(list, target, name, [str(each) for each in value])

    def getLongProperty(self, target: Handle, name: str, options: Options = NO_OPTIONS) -> Any:
        """Return a whole number."""
        return self._any_property(target, name, options)

    def setLongProperty(self, target: Handle, name: str, value: int) -> None:
        """Set a whole number."""
        self._set_property(int, target, name, value)

    def getHandleProperty(self, target: Handle, name: str, options: Options = NO_OPTIONS) -> Any:
        """Return the handle of an object."""
        return self._any_property(target, name, options)

    def setHandleProperty(self, target: Handle, name: str, value: int) -> None:
        """Set the handle of an object: the property parent."""
        self._set_property(int, target, name, value)

    def getHandleArrayProperty(self, target: Handle, name: str, options: Options = NO_OPTIONS) -> Any:
        """Return handles of objects: the property children."""
        return self._any_property(target, name, options)

    def getVector3Property(self, target: Handle, name: str, options: Options = NO_OPTIONS) -> Any:
        """Return three numbers."""
        return self._any_property(target, name, options)

    def setVector3Property(self, target: Handle, name: str, value: Vector3) -> None:
        """Set three numbers."""
        self._set_property(list, target, name, value)

    def getQuaternionProperty(self, target: Handle, name: str, options: Options = NO_OPTIONS) -> Any:
        """Return a quaternion, x, y, z, w."""
        return self._any_property(target, name, options)

    def setQuaternionProperty(self, target: Handle, name: str, value: Vector4) -> None:
        """Set a quaternion, x, y, z, w."""
        self._set_property(list, target, name, value)

    def getPoseProperty(self, target: Handle, name: str, options: Options = NO_OPTIONS) -> Any:
        """Return a pose, position and quaternion."""
        return self._any_property(target, name, options)

    def setPoseProperty(self, target: Handle, name: str, value: Vector7) -> None:
        """Set a pose, position and quaternion."""
        self._set_property(list, target, name, value)

    def getColorProperty(self, target: Handle, name: str, options: Options = NO_OPTIONS) -> Any:
        """Return a colour, red, green, blue from 0 to 1."""
        return self._any_property(target, name, options)

    def setColorProperty(self, target: Handle, name: str, value: Vector3) -> None:
        """Set a colour, red, green, blue from 0 to 1."""
        self._set_property(list, target, name, value)

    def getFloatArrayProperty(self, target: Handle, name: str, options: Options = NO_OPTIONS) -> Any:
        """Return a list of numbers."""
        return self._any_property(target, name, options)

    def setFloatArrayProperty(self, target: Handle, name: str, value: Numbers) -> None:
        """Set a list of numbers."""
        self._set_property(list, target, name, value)

    def getIntArrayProperty(self, target: Handle, name: str, options: Options = NO_OPTIONS) -> Any:
        """Return a list of integers."""
        return self._any_property(target, name, options)

    def setIntArrayProperty(self, target: Handle, name: str, value: Integers) -> None:
        """Set a list of integers."""
        self._set_property(list, target, name, value)

    def _properties(self, target: int) -> dict[str, Property]:
        """Return the properties that an object, or the scene, has beside signals and custom data."""
        if target in (self.handle_scene, self.handle_app):
            return OF_SCENE if target == self.handle_scene else OF_APP
        sim: Any = self
        kind = sim.getObjectType(target)
        return {name: each for name, each in OF_OBJECTS.items() if not each.types or kind in each.types}

    def _property(self, target: int, name: str) -> Property | None:
        known = {self.handle_scene: OF_SCENE, self.handle_app: OF_APP}.get(target, OF_OBJECTS)
        return known.get(name) if name in known and name in self._properties(target) else None

    def _any_property(self, target: int, name: str, options: Options) -> Any:
        try:
            found = self._property(target, name)
            if found is not None:
                return found.get(self, target)
            key = self._data_key(target, name)
            if key is not None:
                return self._caller.shared.custom_data.get(key)
            signals = self._caller.shared.signals
            wanted = self._signal(target, name)
            return next((value for (_, signal), value in signals.items() if signal == wanted), None)
        except ValueError:
            if options.get("noError"):
                return None
            raise

    def _get_property(self, kind: type, target: int, name: str) -> Any:
        found = self._property(target, name)
        if found is None:
            return super()._get_property(kind, target, name)
        value = found.get(self, target)
        if kind in _NUMBERS:
            require_type(name, value, _NUMBERS)
        return value

    def _set_property(self, kind: type, target: int, name: str, value: object) -> None:
        found = self._property(target, name)
        if found is None:
            super()._set_property(kind, target, name, value)
        elif found.set is None:
            raise ValueError(f"the property '{name}' cannot be set")
        else:
            found.set(self, target, value)
