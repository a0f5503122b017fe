# SPDX-License-Identifier: BSD-3-Clause
"""The properties of objects, by their names."""

from __future__ import annotations

import math
from typing import Any

from bubblesim.scripting.api.sim.constants import SimConstants as Sim
from bubblesim.scripting.api.sim.property_kinds import Property, Set, flag, float_parameter, int_parameter

_JOINT, _SHAPE, _CAMERA = (Sim.object_joint_type,), (Sim.object_shape_type,), (Sim.object_visionsensor_type,)
_PROXIMITY, _DUMMY = (Sim.object_proximitysensor_type,), (Sim.object_dummy_type,)
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


def _turning(sim: Any, handle: int) -> list[float]:
    angular: list[float] = sim.getObjectVelocity(handle)[1]
    return angular


def _axis(sim: Any, handle: int) -> list[float]:
    angular = _turning(sim, handle)
    speed = math.hypot(*angular)
    return [part / speed for part in angular] if speed > 0 else [0.0, 0.0, 0.0]


def _set_resolution(sim: Any, handle: int, value: Any) -> None:
    for parameter, pixels in zip(
        (Sim.visionintparam_resolution_x, Sim.visionintparam_resolution_y), value, strict=True
    ):
        sim.setObjectInt32Param(handle, parameter, int(pixels))


def _set_velocity(first: int) -> Set:
    def write(sim: Any, handle: int, value: Any) -> None:
        for number, part in enumerate(value):
            sim.setObjectFloatParam(handle, first + number, float(part))

    return write


def _dependency(sim: Any, handle: int) -> list[float]:
    return [float(number) for number in sim.getJointDependency(handle)[1:]]


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
    "resolution": Property(lambda sim, h: list(sim.getVisionSensorRes(h)), _set_resolution, types=_CAMERA),
    "name": Property(lambda sim, h: sim.getObjectAlias(h), lambda sim, h, v: sim.setObjectAlias(h, v)),
    "deprecatedName": Property(lambda sim, h: sim.getObjectName(h)),
    "uid": Property(lambda sim, h: sim.getObjectUid(h)),
    "persistentUid": Property(lambda sim, h: str(sim.getObjectUid(h))),
    "layer": int_parameter(Sim.objintparam_visibility_layer),
    "visible": Property(lambda sim, h: sim.getObjectInt32Param(h, sim.objintparam_visibility_layer) != 0),
    "selectable": flag("getObjectProperty", Sim.objectproperty_selectable),
    "cannotDelete": flag("getObjectProperty", Sim.objectproperty_cannotdelete),
    "collidable": flag("getObjectSpecialProperty", Sim.objectspecialproperty_collidable),
    "measurable": flag("getObjectSpecialProperty", Sim.objectspecialproperty_measurable),
    "detectable": flag("getObjectSpecialProperty", Sim.objectspecialproperty_detectable),
    "modelNotVisible": flag("getModelProperty", Sim.modelproperty_not_visible),
    "modelNotDynamic": flag("getModelProperty", Sim.modelproperty_not_dynamic),
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
    "viewAngle": float_parameter(Sim.visionfloatparam_perspective_angle, _CAMERA),
    "nearClippingPlane": float_parameter(Sim.visionfloatparam_near_clipping, _CAMERA),
    "farClippingPlane": float_parameter(Sim.visionfloatparam_far_clipping, _CAMERA),
    "detectedObjectHandle": Property(lambda sim, h: sim.readProximitySensor(h)[3], types=_PROXIMITY),
    "detectedPoint": Property(lambda sim, h: sim.readProximitySensor(h)[2], types=_PROXIMITY),
    "detectedNormal": Property(lambda sim, h: sim.readProximitySensor(h)[4], types=_PROXIMITY),
    "explicitHandling": Property(lambda sim, h: False, types=(*_PROXIMITY, *_CAMERA)),
}
OF_OBJECTS |= {  # names of 4.8
    "targetPos": OF_OBJECTS["targetPosition"],
    "targetVel": OF_OBJECTS["targetVelocity"],
}
