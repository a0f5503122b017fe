# SPDX-License-Identifier: BSD-3-Clause
"""Properties of objects, the scene and the simulator that are less common, and what is known of a property."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from bubblesim.scripting.api.sim.constants import SimConstants as Sim

Get = Callable[[Any, int], Any]  # of the module and a handle
Set = Callable[[Any, int, Any], object]


@dataclass(frozen=True)
class Property:
    """A property of objects."""

    get: Get
    set: Set | None = None
    types: tuple[int, ...] = ()
    """Types of objects that have it; empty for all."""
    leads_to_objects: bool = False
    """Its values are handles."""


_JOINT, _SHAPE, _CAMERA = (Sim.object_joint_type,), (Sim.object_shape_type,), (Sim.object_visionsensor_type,)
_PROXIMITY, _DUMMY = (Sim.object_proximitysensor_type,), (Sim.object_dummy_type,)
_NAMES = {
    Sim.propertytype_bool: "bool",
    Sim.propertytype_int: "int",
    Sim.propertytype_float: "float",
    Sim.propertytype_string: "string",
    Sim.propertytype_buffer: "buffer",
    Sim.propertytype_vector3: "vector3",
    Sim.propertytype_quaternion: "quaternion",
    Sim.propertytype_pose: "pose",
    Sim.propertytype_color: "color",
    Sim.propertytype_floatarray: "floatarray",
    Sim.propertytype_table: "table",
    Sim.propertytype_intarray: "intarray",
    Sim.propertytype_null: "null",
}
_BY_LENGTH = {3: Sim.propertytype_vector3, 4: Sim.propertytype_quaternion, 7: Sim.propertytype_pose}


def int_parameter(parameter: int, types: tuple[int, ...] = ()) -> Property:
    """Return an integer parameter as a property."""
    return Property(
        lambda sim, handle: sim.getObjectInt32Param(handle, parameter),
        lambda sim, handle, value: sim.setObjectInt32Param(handle, parameter, int(value)),
        types,
    )


def _float_parameter(parameter: int, types: tuple[int, ...]) -> Property:
    return Property(
        lambda sim, handle: sim.getObjectFloatParam(handle, parameter),
        lambda sim, handle, value: sim.setObjectFloatParam(handle, parameter, float(value)),
        types,
    )


def _flag(read: str, bit: int) -> Property:
    """Return a bit of what getObjectProperty, or a function like it, returns."""

    def write(sim: Any, handle: int, value: object) -> None:
        before = getattr(sim, read)(handle)
        getattr(sim, read.replace("get", "set"))(handle, before | bit if value else before & ~bit)

    return Property(lambda sim, handle: bool(getattr(sim, read)(handle) & bit), write)


def _turning(sim: Any, handle: int) -> list[float]:
    angular: list[float] = sim.getObjectVelocity(handle)[1]
    return angular


def _axis(sim: Any, handle: int) -> list[float]:
    angular = _turning(sim, handle)
    speed = math.hypot(*angular)
    return [part / speed for part in angular] if speed > 0 else [0.0, 0.0, 0.0]


def _set_velocity(first: int) -> Set:
    def write(sim: Any, handle: int, value: Any) -> None:
        for number, part in enumerate(value):
            sim.setObjectFloatParam(handle, first + number, float(part))

    return write


def _dependency(sim: Any, handle: int) -> list[float]:
    return [float(number) for number in sim.getJointDependency(handle)[1:]]


OF_OBJECTS: dict[str, Property] = {
    "name": Property(lambda sim, h: sim.getObjectAlias(h), lambda sim, h, v: sim.setObjectAlias(h, v)),
    "deprecatedName": Property(lambda sim, h: sim.getObjectName(h)),
    "uid": Property(lambda sim, h: sim.getObjectUid(h)),
    "persistentUid": Property(lambda sim, h: str(sim.getObjectUid(h))),
    "layer": int_parameter(Sim.objintparam_visibility_layer),
    "visible": Property(lambda sim, h: sim.getObjectInt32Param(h, sim.objintparam_visibility_layer) != 0),
    "selectable": _flag("getObjectProperty", Sim.objectproperty_selectable),
    "cannotDelete": _flag("getObjectProperty", Sim.objectproperty_cannotdelete),
    "collidable": _flag("getObjectSpecialProperty", Sim.objectspecialproperty_collidable),
    "measurable": _flag("getObjectSpecialProperty", Sim.objectspecialproperty_measurable),
    "detectable": _flag("getObjectSpecialProperty", Sim.objectspecialproperty_detectable),
    "modelNotVisible": _flag("getModelProperty", Sim.modelproperty_not_visible),
    "modelNotDynamic": _flag("getModelProperty", Sim.modelproperty_not_dynamic),
    "calcRotationVelocity": Property(lambda sim, h: math.hypot(*_turning(sim, h))),
    "calcRotationAxis": Property(_axis),
    "hierarchyOrder": Property(lambda sim, h: sim.getObjectHierarchyOrder(h)),
    "bbPos": Property(lambda sim, h: [0.0, 0.0, 0.0], types=_SHAPE),
    "size": Property(lambda sim, h: sim.getShapeBB(h), lambda sim, h, v: sim.setShapeBB(h, v), _SHAPE),
    "primitive": Property(lambda sim, h: sim.getShapeGeomInfo(h)[0] & 2 != 0, types=_SHAPE),
    "compound": Property(lambda sim, h: sim.getShapeGeomInfo(h)[0] & 1 != 0, types=_SHAPE),
    "respondableMask": int_parameter(Sim.shapeintparam_respondable_mask, _SHAPE),
    "inertia": Property(lambda sim, h: sim.getShapeInertia(h)[0], types=_SHAPE),
    "centerOfMass": Property(lambda sim, h: sim.getShapeMassAndInertia(h)[2], types=_SHAPE),
    "initLinearVelocity": Property(
        lambda sim, h: sim.getObjectVelocity(h)[0], _set_velocity(Sim.shapefloatparam_init_velocity_x), _SHAPE
    ),
    "initAngularVelocity": Property(_turning, _set_velocity(Sim.shapefloatparam_init_velocity_a), _SHAPE),
    "motorEnabled": int_parameter(Sim.jointintparam_motor_enabled, _JOINT),
    "dependencyMaster": Property(
        lambda sim, h: sim.getJointDependency(h)[0], lambda sim, h, v: sim.setJointDependency(h, int(v)), _JOINT
    ),
    "dependencyParams": Property(
        _dependency,
        lambda sim, h, v: sim.setJointDependency(h, sim.getJointDependency(h)[0], float(v[0]), float(v[1])),
        _JOINT,
    ),
    "dummySize": Property(lambda sim, h: sim.getDummySize(h), types=_DUMMY),
    "viewAngle": _float_parameter(Sim.visionfloatparam_perspective_angle, _CAMERA),
    "nearClippingPlane": _float_parameter(Sim.visionfloatparam_near_clipping, _CAMERA),
    "farClippingPlane": _float_parameter(Sim.visionfloatparam_far_clipping, _CAMERA),
    "detectedObjectHandle": Property(lambda sim, h: sim.readProximitySensor(h)[3], types=_PROXIMITY),
    "detectedPoint": Property(lambda sim, h: sim.readProximitySensor(h)[2], types=_PROXIMITY),
    "detectedNormal": Property(lambda sim, h: sim.readProximitySensor(h)[4], types=_PROXIMITY),
    "explicitHandling": Property(lambda sim, h: False, types=(*_PROXIMITY, *_CAMERA)),
}
OF_SCENE: dict[str, Property] = {
    "sceneName": Property(lambda sim, h: sim.getStringParam(sim.stringparam_scene_name)),
    "dynamicsEngine": Property(lambda sim, h: [sim.getInt32Param(sim.intparam_dynamic_engine), 0]),
    "dynamicsStepSize": Property(lambda sim, h: sim.getFloatParam(sim.floatparam_physicstimestep)),
    "dynamicsEnabled": Property(lambda sim, h: sim.getBoolParam(sim.boolparam_dynamics_handling_enabled)),
    "realtimeSimulation": Property(
        lambda sim, h: sim.getBoolParam(sim.boolparam_realtime_simulation),
        lambda sim, h, v: sim.setBoolParam(sim.boolparam_realtime_simulation, bool(v)),
    ),
    "objects": Property(lambda sim, h: sim.getObjectsInTree(sim.handle_scene), leads_to_objects=True),
    "orphans": Property(
        lambda sim, h: sim.getObjectsInTree(sim.handle_scene, sim.handle_all, 2), leads_to_objects=True
    ),
    "selection": Property(
        lambda sim, h: sim.getObjectSel(), lambda sim, h, v: sim.setObjectSel(v), leads_to_objects=True
    ),
    "simulationTimeStep": Property(lambda sim, h: sim.getSimulationTimeStep()),
}
OF_APP: dict[str, Property] = {
    "productVersionNb": Property(lambda sim, h: sim.getInt32Param(sim.intparam_program_full_version)),
    "protocolVersion": Property(lambda sim, h: 2),
    "headlessMode": Property(lambda sim, h: int(sim.getBoolParam(sim.boolparam_headless))),
    "platform": Property(lambda sim, h: sim.platform_linux),
    "appPath": Property(lambda sim, h: sim.getStringParam(sim.stringparam_application_path)),
    "tempPath": Property(lambda sim, h: sim.getStringParam(sim.stringparam_tempdir)),
    "systemTime": Property(lambda sim, h: sim.getSystemTime()),
}


def type_of(name: str, value: object) -> int:
    """Return sim.propertytype_float ... of a value."""
    if value is None:
        return Sim.propertytype_null
    if isinstance(value, bool):
        return Sim.propertytype_bool
    for kind, number in (
        (int, Sim.propertytype_int),
        (float, Sim.propertytype_float),
        (str, Sim.propertytype_string),
        (bytes, Sim.propertytype_buffer),
        (Mapping, Sim.propertytype_table),
    ):
        if isinstance(value, kind):
            return number
    if not isinstance(value, list | tuple):
        return Sim.propertytype_table
    if name.startswith("color."):
        return Sim.propertytype_color
    if all(isinstance(each, int) for each in value):
        return Sim.propertytype_intarray
    if not all(isinstance(each, int | float) for each in value):
        return Sim.propertytype_table
    return _BY_LENGTH.get(len(value), Sim.propertytype_floatarray)


def type_name(number: int) -> str:
    """Return 'float' ... of a type of properties."""
    return _NAMES.get(number, "")
