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
from bubblesim.scripting.api.sim import more_properties
from bubblesim.scripting.api.sim.constants import SimConstants as Sim
from bubblesim.scripting.api.sim.custom_data import CustomDataFunctions
from bubblesim.scripting.api.sim.more_properties import OF_APP, Property, int_parameter, type_name, type_of
from bubblesim.scripting.api.sim.scene_objects import SceneObject
from bubblesim.scripting.api.sim.signals import require_type

_NUMBERS = (int, float)


_JOINT, _SHAPE, _CAMERA = (Sim.object_joint_type,), (Sim.object_shape_type,), (Sim.object_visionsensor_type,)
_PARENT, _WORLD = Sim.handle_parent, Sim.handle_world
_TYPE_NAMES = {
    Sim.object_shape_type: "shape",
    Sim.object_joint_type: "joint",
    Sim.object_graph_type: "graph",
    Sim.object_camera_type: "camera",
    Sim.object_dummy_type: "dummy",
    Sim.object_proximitysensor_type: "proximitySensor",
    Sim.object_visionsensor_type: "visionSensor",
    Sim.object_forcesensor_type: "forceSensor",
    Sim.object_light_type: "light",
    Sim.object_script_type: "script",
}


def _above(sim: Any, handle: int) -> int:
    parent: int = sim.getObjectParent(handle)
    return parent


def _children(sim: Any, handle: int) -> list[int]:
    found: list[int] = sim.getObjectsInTree(handle, sim.handle_all, 3)
    return found


OF_OBJECTS: dict[str, Property] = {
    "alias": Property(lambda sim, h: sim.getObjectAlias(h), lambda sim, h, v: sim.setObjectAlias(h, v)),
    "handle": Property(lambda sim, h: h),
    "objectType": Property(lambda sim, h: _TYPE_NAMES[sim.getObjectType(h)]),
    "parent": Property(_above, lambda sim, h, v: sim.setObjectParent(h, v, True), leads_to_objects=True),
    "parentHandle": Property(_above, lambda sim, h, v: sim.setObjectParent(h, v, True)),
    "children": Property(_children, leads_to_objects=True),
    "modelBase": Property(lambda sim, h: sim.getModelProperty(h) != sim.modelproperty_not_model),
    "selected": Property(lambda sim, h: h in sim.getObjectSel()),
    "pose": Property(
        lambda sim, h: sim.getObjectPose(h, _above(sim, h)), lambda sim, h, v: sim.setObjectPose(h, v, _above(sim, h))
    ),
    "position": Property(
        lambda sim, h: sim.getObjectPosition(h, _above(sim, h)),
        lambda sim, h, v: sim.setObjectPosition(h, v, _above(sim, h)),
    ),
    "quaternion": Property(
        lambda sim, h: sim.getObjectQuaternion(h, _above(sim, h)),
        lambda sim, h, v: sim.setObjectQuaternion(h, v, _above(sim, h)),
    ),
    "eulerAngles": Property(
        lambda sim, h: sim.getObjectOrientation(h, _above(sim, h)),
        lambda sim, h, v: sim.setObjectOrientation(h, v, _above(sim, h)),
    ),
    "absPose": Property(lambda sim, h: sim.getObjectPose(h), lambda sim, h, v: sim.setObjectPose(h, v, _WORLD)),
    "absPosition": Property(
        lambda sim, h: sim.getObjectPosition(h), lambda sim, h, v: sim.setObjectPosition(h, v, _WORLD)
    ),
    "absQuaternion": Property(
        lambda sim, h: sim.getObjectQuaternion(h), lambda sim, h, v: sim.setObjectQuaternion(h, v, _WORLD)
    ),
    "absEulerAngles": Property(
        lambda sim, h: sim.getObjectOrientation(h), lambda sim, h, v: sim.setObjectOrientation(h, v, _WORLD)
    ),
    "calcLinearVelocity": Property(lambda sim, h: sim.getObjectVelocity(h)[0]),
    "bbHSize": Property(lambda sim, h: [size / 2 for size in sim.getShapeBB(h)], types=_SHAPE),
    "mass": Property(lambda sim, h: sim.getShapeMass(h), lambda sim, h, v: sim.setShapeMass(h, v), _SHAPE),
    "dynamic": Property(
        lambda sim, h: not sim.getObjectInt32Param(h, sim.shapeintparam_static),
        lambda sim, h, v: sim.setObjectInt32Param(h, sim.shapeintparam_static, int(not v)),
        _SHAPE,
    ),
    "respondable": Property(
        lambda sim, h: bool(sim.getObjectInt32Param(h, sim.shapeintparam_respondable)),
        lambda sim, h, v: sim.setObjectInt32Param(h, sim.shapeintparam_respondable, int(bool(v))),
        _SHAPE,
    ),
    "dynLinearVelocity": Property(lambda sim, h: sim.getObjectVelocity(h)[0], types=_SHAPE),
    "dynAngularVelocity": Property(lambda sim, h: sim.getObjectVelocity(h)[1], types=_SHAPE),
    "color.diffuse": Property(
        lambda sim, h: sim.getObjectColor(h, 0, sim.colorcomponent_ambient_diffuse),
        lambda sim, h, v: sim.setObjectColor(h, 0, sim.colorcomponent_ambient_diffuse, v),
    ),
    "jointType": Property(lambda sim, h: sim.getJointType(h), types=_JOINT),
    "jointMode": Property(
        lambda sim, h: sim.getJointMode(h)[0], lambda sim, h, v: sim.setJointMode(h, v), types=_JOINT
    ),
    "dynCtrlMode": int_parameter(Sim.jointintparam_dynctrlmode, _JOINT),
    "cyclic": Property(lambda sim, h: sim.getJointInterval(h)[0], types=_JOINT),
    "interval": Property(lambda sim, h: sim.getJointInterval(h)[1], types=_JOINT),
    "jointPosition": Property(
        lambda sim, h: sim.getJointPosition(h), lambda sim, h, v: sim.setJointPosition(h, v), _JOINT
    ),
    "jointVelocity": Property(lambda sim, h: sim.getJointVelocity(h), types=_JOINT),
    "jointForce": Property(lambda sim, h: sim.getJointForce(h), types=_JOINT),
    "targetPosition": Property(
        lambda sim, h: sim.getJointTargetPosition(h), lambda sim, h, v: sim.setJointTargetPosition(h, v), _JOINT
    ),
    "targetVelocity": Property(
        lambda sim, h: sim.getJointTargetVelocity(h), lambda sim, h, v: sim.setJointTargetVelocity(h, v), _JOINT
    ),
    "targetForce": Property(
        lambda sim, h: sim.getJointTargetForce(h), lambda sim, h, v: sim.setJointTargetForce(h, v), _JOINT
    ),
    "resolution": Property(lambda sim, h: list(sim.getVisionSensorRes(h)), types=_CAMERA),
}
OF_OBJECTS |= more_properties.OF_OBJECTS
OF_OBJECTS |= {  # names of 4.8
    "targetPos": OF_OBJECTS["targetPosition"],
    "targetVel": OF_OBJECTS["targetVelocity"],
}
OF_SCENE: dict[str, Property] = {
    "gravity": Property(
        lambda sim, h: sim.getArrayParam(sim.arrayparam_gravity),
        lambda sim, h, v: sim.setArrayParam(sim.arrayparam_gravity, v),
    ),
    "simulationTime": Property(lambda sim, h: sim.getSimulationTime()),
    "simulationState": Property(lambda sim, h: sim.getSimulationState()),
    "timeStep": Property(lambda sim, h: sim.getSimulationTimeStep(), lambda sim, h, v: sim.setSimulationTimeStep(v)),
    "scenePath": Property(lambda sim, h: sim.getStringParam(sim.stringparam_scene_path_and_name)),
}
OF_SCENE |= more_properties.OF_SCENE


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
