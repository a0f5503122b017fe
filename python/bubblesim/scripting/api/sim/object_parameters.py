# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for parameters of objects and of the physics engine."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from bubblesim._core import WrongObject, camera_optics
from bubblesim.scripting.api.checked_calls import refusal_warns
from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.kinds import Handle
from bubblesim.scripting.api.sim.joints import JointFunctions
from bubblesim.scripting.api.sim.object_collections import CollectionFunctions
from bubblesim.scripting.api.sim.sensor_changes import SensorChangeFunctions

_ENGINE_KEPT = "it reads a parameter of a physics engine; here what scripts set is kept, without effect on the physics"
_ENGINE_SET = "it sets a parameter of a physics engine; here the number is kept, without effect on the physics"

_OF_OBJECTS = ("obj", "vision", "joint", "shape", "prox", "force", "light", "camera", "dummy")
_OF_ENGINES = ("bullet", "ode", "newton")


class ObjectParameterFunctions(JointFunctions, SensorChangeFunctions, CollectionFunctions):
    """Parameters of objects by their number, sim.jointfloatparam_velocity for example. Those without effect here, such
    as the settings of other physics engines, keep what is set; they are 0 before."""

    def getObjectInt32Param(self, handle: Handle, parameter: int) -> int:
        """Return an integer parameter of an object: sim.jointintparam_dynctrlmode, motor_enabled and ctrl_enabled of a
        joint, visionintparam_resolution_x and y of a camera, shapeintparam_static and shapeintparam_respondable of a
        model or link, proxintparam_entity_to_detect of a proximity sensor.

        The control modes of joints are sim.jointdynctrl_free, force, velocity, position, and callback: sysCall_joint.
        """
        handle = self._resolve(handle)
        read = self._integers().get(parameter)
        return int(self._kept(int, handle, parameter) if read is None else read(handle))

    @refusal_warns
    def setObjectInt32Param(self, handle: Handle, parameter: int, value: int) -> None:
        """Set sim.jointintparam_dynctrlmode, the control mode of a joint, or motor_enabled and ctrl_enabled, or
        proxintparam_entity_to_detect, the object or collection that a proximity sensor detects, until the scene is
        reset; or of a model sim.shapeintparam_static (1: physics does not move it), of a created shape
        sim.shapeintparam_respondable, of a created camera visionintparam_resolution_x and y."""
        handle = self._resolve(handle)
        write = self._settable_integers().get(parameter)
        if write is not None:
            write(handle, value)
        elif parameter in self._integers():
            if self._integers()[parameter](handle) != value:
                raise WrongObject(f"{self._parameter_name(parameter)} of {self._tree.short_path(handle)} cannot be set")
        else:
            self._keep(int, handle, parameter, value)

    def getObjectFloatParam(self, handle: Handle, parameter: int) -> float:
        """Return a number of an object: sim.jointfloatparam_velocity and upper_limit, the angle of a camera
        sim.visionfloatparam_perspective_angle (rad), sim.objfloatparam_abs_x_velocity, y and z (m/s) and
        abs_rot_velocity (rad/s), sim.shapefloatparam_mass (kg); sim.objfloatparam_objbbox_min_x to max_z (m) of the box
        along the object's axes around what collides, modelbbox_min_x to max_z of that around its whole model."""
        handle = self._resolve(handle)
        if self.objfloatparam_objbbox_min_x <= parameter <= self.objfloatparam_modelbbox_max_z:
            return self._side_of_box(handle, parameter - self.objfloatparam_objbbox_min_x)
        if self.objfloatparam_abs_x_velocity <= parameter <= self.objfloatparam_abs_rot_velocity:
            linear, angular = self._world.velocity(handle)
            return float([*linear, math.hypot(*angular)][parameter - self.objfloatparam_abs_x_velocity])
        read = self._floats().get(parameter)
        return float(self._kept(float, handle, parameter) if read is None else read(handle))

    @refusal_warns
    def setObjectFloatParam(self, handle: Handle, parameter: int, value: float) -> None:
        """Set a number of an object: sim.shapefloatparam_mass (kg); sim.shapefloatparam_init_velocity_x, y, z (m/s) and
        init_velocity_a, b, g (rad/s) give a model or link that velocity now, in world axes."""
        handle = self._resolve(handle)
        if parameter == self.shapefloatparam_mass:
            self.setShapeMass(self._shown(handle), value)
        elif parameter in self._velocities():
            linear, angular = (list(part) for part in self._world.velocity(handle))
            number = self._velocities().index(parameter)
            (linear if number < 3 else angular)[number % 3] = value
            self._world.set_state(handle, self._world.pose(handle), linear, angular)
        elif parameter in self._floats():
            if not math.isclose(self._floats()[parameter](handle), value, rel_tol=1e-6, abs_tol=1e-9):
                raise WrongObject(f"{self._parameter_name(parameter)} of {self._tree.short_path(handle)} cannot be set")
        else:
            self._keep(float, handle, parameter, value)

    def getObjectStringParam(self, handle: Handle, parameter: int) -> str:
        """Return a string of an object: sim.objstringparam_unique_id, and those that were set."""
        handle = self._resolve(handle)
        if parameter == self.objstringparam_unique_id:
            self._tree.kind(handle)  # raises
            return str(handle)
        return str(self._kept(str, handle, parameter))

    def setObjectStringParam(self, handle: Handle, parameter: int, value: str) -> None:
        """Keep a string of an object."""
        self._keep(str, self._resolve(handle), parameter, value)

    def getObjectBoolParam(self, handle: Handle, parameter: int) -> bool:
        """Return a flag of an object, an integer parameter that is not 0."""
        return self.getObjectInt32Param(handle, parameter) != 0

    def setObjectBoolParam(self, handle: Handle, parameter: int, value: bool) -> None:
        """Set a flag of an object, an integer parameter."""
        self.setObjectInt32Param(handle, parameter, int(value))

    @differs(_ENGINE_KEPT)
    def getEngineInt32Param(self, parameter: int, handle: int = -1, data: object = None, ok: object = None) -> int:
        """Return an integer that was set for a physics engine; 0 if none was. Settings of engines have no effect."""
        return int(self._kept_of_engine(int, parameter, handle))

    @differs(_ENGINE_SET)
    def setEngineInt32Param(self, parameter: int, handle: int, data: Any, value: Any = None) -> None:
        """Keep an integer for a physics engine; its arguments are parameter, handle, data (nil) and value."""
        self._keep_of_engine(int, parameter, handle, data if value is None else value)

    @differs(_ENGINE_KEPT)
    def getEngineFloatParam(self, parameter: int, handle: int = -1, data: object = None, ok: object = None) -> float:
        """Return a number that was set for a physics engine; 0 if none was. Settings of engines have no effect."""
        return float(self._kept_of_engine(float, parameter, handle))

    @differs(_ENGINE_SET)
    def setEngineFloatParam(self, parameter: int, handle: int, data: Any, value: Any = None) -> None:
        """Keep a number for a physics engine; its arguments are parameter, handle, data (nil) and value."""
        self._keep_of_engine(float, parameter, handle, data if value is None else value)

    @differs(_ENGINE_KEPT)
    def getEngineBoolParam(self, parameter: int, handle: int = -1, data: object = None, ok: object = None) -> bool:
        """Return a flag that was set for a physics engine; false if none was. Settings of engines have no effect."""
        return bool(self._kept_of_engine(bool, parameter, handle))

    @differs(_ENGINE_SET)
    def setEngineBoolParam(self, parameter: int, handle: int, data: Any, value: Any = None) -> None:
        """Keep a flag for a physics engine; its arguments are parameter, handle, data (nil) and value."""
        self._keep_of_engine(bool, parameter, handle, data if value is None else value)

    def getModelProperty(self, handle: Handle) -> int:
        """Return 0 for a model, and sim.modelproperty_not_model for another object, or what was set."""
        handle = self._resolve(handle)
        own = 0 if self._world.is_model_base(handle) else self.modelproperty_not_model
        return int(self._caller.shared.settings.get((int, f"model property {handle}"), own))

    @differs("flags hide, disable ... a model; here they are kept, without effect")
    def setModelProperty(self, handle: Handle, value: int) -> None:
        """Keep flags of a model, sim.modelproperty_not_visible for example; they have no effect."""
        handle = self._resolve(handle)
        self._tree.kind(handle)  # raises
        self._caller.shared.settings[int, f"model property {handle}"] = value

    def getObjectProperty(self, handle: Handle) -> int:
        """Return flags of an object, sim.objectproperty_selectable for example, or what was set."""
        return self._flags(handle, "property", self.objectproperty_selectable)

    @differs("flags hide, lock ... an object; here they are kept, without effect")
    def setObjectProperty(self, handle: Handle, value: int) -> None:
        """Keep flags of an object; they have no effect."""
        self._keep_flags(handle, "property", value)

    def getObjectSpecialProperty(self, handle: Handle) -> int:
        """Return what else an object is, sim.objectspecialproperty_collidable for example: of a shape all, or what was
        set."""
        handle = self._resolve(handle)
        all_of_a_shape = (
            self.objectspecialproperty_collidable
            | self.objectspecialproperty_measurable
            | self.objectspecialproperty_detectable_all
            | self.objectspecialproperty_renderable
        )
        is_shape = self._tree.kind(handle) in ("model", "link", "shape")
        return self._flags(handle, "special property", all_of_a_shape if is_shape else 0)

    @differs("it also sets what sensors detect; here sim.proxintparam_entity_to_detect and collections do")
    def setObjectSpecialProperty(self, handle: Handle, value: int) -> None:
        """Keep what else an object is. sim.checkCollision and checkDistance leave out shapes that are not collidable or
        measurable; for sensors it has no effect, use sim.proxintparam_entity_to_detect."""
        self._keep_flags(handle, "special property", value)

    def _flags(self, handle: int, what: str, default: int) -> int:
        handle = self._resolve(handle)
        self._tree.kind(handle)  # raises
        return int(self._caller.shared.settings.get((int, f"{what} {handle}"), default))

    def _keep_flags(self, handle: int, what: str, value: int) -> None:
        handle = self._resolve(handle)
        self._tree.kind(handle)  # raises
        self._caller.shared.settings[int, f"{what} {handle}"] = value

    def _integers(self) -> dict[int, Callable[[int], int]]:
        """Return the functions that read integer parameters."""
        return {
            self.jointintparam_dynctrlmode: self._control_mode,
            self.jointintparam_motor_enabled: lambda joint: int(self._control_mode(joint) != self.jointdynctrl_free),
            self.jointintparam_ctrl_enabled: lambda joint: int(self._control_mode(joint) == self.jointdynctrl_position),
            self.shapeintparam_static: lambda shape: int(self._is_static(shape)),
            self.shapeintparam_respondable: lambda shape: int(self._is_respondable(shape)),
            self.visionintparam_resolution_x: lambda camera: self._optics_of(camera)[0],
            self.visionintparam_resolution_y: lambda camera: self._optics_of(camera)[1],
            self.proxintparam_entity_to_detect: self._entity_to_detect,
        }

    def _settable_integers(self) -> dict[int, Callable[[int, int], None]]:
        return {
            self.jointintparam_dynctrlmode: self._set_control_mode,
            self.jointintparam_motor_enabled: self._enable_motor,
            self.jointintparam_ctrl_enabled: self._enable_control,
            self.shapeintparam_static: lambda shape, value: self._set_static(shape, value != 0),
            self.shapeintparam_respondable: lambda shape, value: self._set_respondable(shape, value != 0),
            self.proxintparam_entity_to_detect: self._set_entity_to_detect,
            self.visionintparam_resolution_x: lambda camera, value: self._set_pixels(camera, columns=value),
            self.visionintparam_resolution_y: lambda camera, value: self._set_pixels(camera, rows=value),
        }

    def _side_of_box(self, handle: int, side: int) -> float:
        """Return the lowest x, y and z, then the highest ones, of an object, then of its model; 0 without a shape."""
        if self._tree.kind(handle) not in ("model", "link"):
            return 0.0
        is_link = self._tree.kind(handle) == "link"
        links = [handle] if is_link and side < 6 else self._world.parts(self._tree.model(handle), "link")
        found = self._box_of(links, handle)
        return 0.0 if found is None else float([*found[0], *found[1]][side % 6])

    def _floats(self) -> dict[int, Callable[[int], float]]:
        """Return the functions that read numbers."""
        return {
            self.jointfloatparam_velocity: lambda joint: float(self._world.joint_velocity(joint)),
            self.jointfloatparam_upper_limit: lambda joint: float(self._world.joint_limits(joint)[1]),
            self.visionfloatparam_perspective_angle: self._angle_of_view,
            self.objfloatparam_size_factor: lambda handle: 1.0,
            self.shapefloatparam_mass: lambda shape: self.getShapeMass(self._shown(shape)),
        }

    def _velocities(self) -> list[int]:
        first, turning = self.shapefloatparam_init_velocity_x, self.shapefloatparam_init_velocity_a
        return [first, first + 1, first + 2, turning, turning + 1, turning + 2]

    def _optics_of(self, camera: int) -> tuple[int, int, float]:
        columns, rows, angle = camera_optics(self._simulation, self._sensor(camera))
        return int(columns), int(rows), float(angle)

    def _angle_of_view(self, camera: int) -> float:
        """Return the angle of a camera's larger side, rad."""
        columns, rows, angle = self._optics_of(camera)
        return angle if columns >= rows else 2 * math.atan(math.tan(angle / 2) * rows / columns)

    def _control_mode(self, joint: int) -> int:
        if self._edits.callback_joints.get(joint, self._world.is_driven_by_callback(joint)):
            return self.jointdynctrl_callback
        mode = self._world.motor_mode(joint)
        return next(number for number, known in self._control_modes().items() if known == mode)

    def _set_control_mode(self, joint: int, value: int) -> None:
        if value == self.jointdynctrl_callback:
            self._world.motor_mode(joint)  # raises
            self._edits.callback_joints[joint] = True
            return
        if value not in self._control_modes():
            raise ValueError(
                f"{value} is not a control mode of a joint; valid ones: sim.jointdynctrl_free, jointdynctrl_force, "
                "jointdynctrl_velocity, jointdynctrl_position and jointdynctrl_callback"
            )
        self._edits.callback_joints[joint] = False
        self._world.set_motor_mode(joint, self._control_modes()[value])

    def _enable_motor(self, joint: int, value: int) -> None:
        """Switch a motor off, or on again with velocity control."""
        if bool(value) != (self._control_mode(joint) != self.jointdynctrl_free):
            self._set_control_mode(joint, self.jointdynctrl_velocity if value else self.jointdynctrl_free)

    def _enable_control(self, joint: int, value: int) -> None:
        """Let a motor control its position, or its velocity."""
        if bool(value) != (self._control_mode(joint) == self.jointdynctrl_position):
            self._set_control_mode(joint, self.jointdynctrl_position if value else self.jointdynctrl_velocity)

    def _entity_to_detect(self, sensor: int) -> int:
        self._world.sonar_limits(self._sensor(sensor))  # raises
        return self._caller.shared.collections.detected.get(self._sensor(sensor), self.handle_all)

    def _set_entity_to_detect(self, sensor: int, entity: int) -> None:
        try:
            self._world.sonar_limits(self._sensor(sensor))
        except WrongObject as error:  # no change that physics refuses: it is no sensor
            raise ValueError(str(error)) from None
        entity = self.handle_all if entity == -1 else entity  # old programs
        if not self._is_entity(entity):
            raise ValueError(f"{entity} is neither an object nor a collection nor sim.handle_all")
        self._caller.shared.collections.detected[self._sensor(sensor)] = entity

    def _kept(self, kind: type, handle: int, parameter: int) -> Any:
        self._check_parameter(parameter, _OF_OBJECTS)
        self._tree.kind(handle)  # raises
        return self._caller.shared.settings.get((kind, f"{parameter} of {handle}"), kind())

    def _keep(self, kind: type, handle: int, parameter: int, value: Any) -> None:
        self._check_parameter(parameter, _OF_OBJECTS)
        self._tree.kind(handle)  # raises
        self._caller.shared.settings[kind, f"{parameter} of {handle}"] = value

    def _kept_of_engine(self, kind: type, parameter: int, handle: int) -> Any:
        return self._caller.shared.settings.get((kind, f"engine {parameter} of {handle}"), kind())

    def _keep_of_engine(self, kind: type, parameter: int, handle: int, value: Any) -> None:
        if not isinstance(value, int | float):
            raise TypeError(f"a parameter of an engine is a number or a flag, found {type(value).__name__}")
        self._caller.shared.settings[kind, f"engine {parameter} of {handle}"] = kind(value)

    def _check_parameter(self, parameter: int, beginnings: tuple[str, ...]) -> None:
        """Raise ValueError for a number that no constant has."""
        if not self._parameter_name(parameter, beginnings):
            names = ", ".join(f"sim.{beginning}intparam_" for beginning in beginnings[:4])
            raise ValueError(f"there is no parameter {parameter}: use a constant of sim that begins with {names} ...")

    def _parameter_name(self, parameter: int, beginnings: tuple[str, ...] = _OF_OBJECTS) -> str:
        for name in dir(type(self)):
            beginning, middle, _ = name.partition("param_")
            known = beginning.removesuffix("int").removesuffix("float").removesuffix("string")
            if middle and known in beginnings and known != beginning and getattr(self, name) == parameter:
                return f"sim.{name}"
        return ""
