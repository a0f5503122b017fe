# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for parameters of the simulator, of objects and of models."""

from __future__ import annotations

import math
import os
from pathlib import Path
from typing import Any

from bubblesim._core import camera_optics
from bubblesim.scripting.api.kinds import Handle, Numbers
from bubblesim.scripting.api.sim.joints import JointFunctions
from bubblesim.scripting.api.sim.logs import LogFunctions
from bubblesim.scripting.api.sim.object_changes import ObjectChangeFunctions
from bubblesim.scripting.api.sim.object_collections import CollectionFunctions
from bubblesim.scripting.api.sim.random_numbers import RandomFunctions

_VERSION = 40700  # of the CoppeliaSim whose functions these are
_LINUX = 2
_ODE = 1


class ParameterFunctions(JointFunctions, ObjectChangeFunctions, CollectionFunctions, RandomFunctions, LogFunctions):
    """Parameters by their number, sim.intparam_program_version for example. Those of windows and drawings, such as
    sim.boolparam_browser_visible and sim.intparam_idle_fps, keep what is set but have no effect. Parameters that are
    not supported raise a ValueError."""

    def getInt32Param(self, parameter: int) -> int:
        """Return an integer parameter of the simulator."""
        known = {
            self.intparam_program_version: _VERSION,
            self.intparam_program_revision: 0,
            self.intparam_dynamic_engine: _ODE,
            self.intparam_platform: _LINUX,
            self.intparam_core_count: os.cpu_count() or 1,
            self.intparam_scene_index: 0,
            self.intparam_scene_unique_id: 1,
        }
        return int(self._get_parameter("intparam", int, parameter, known, self._drawing_integers()))

    def setInt32Param(self, parameter: int, value: int) -> None:
        """Set an integer parameter of the simulator."""
        self._set_parameter("intparam", int, parameter, value, self._drawing_integers())

    def getFloatParam(self, parameter: int) -> float:
        """Return sim.floatparam_simulation_time_step (s) or floatparam_rand, a random number from 0 to 1."""
        if parameter == self.floatparam_rand:
            return self.getRandom()
        return float(self._get_parameter("floatparam", float, parameter, self._times(), {}))

    def setFloatParam(self, parameter: int, value: float) -> None:
        """Set sim.floatparam_simulation_time_step, s, until the simulation stops."""
        if parameter != self.floatparam_simulation_time_step:
            self._set_parameter("floatparam", float, parameter, value, {})
        self._simulation.set_time_step(value)

    def getBoolParam(self, parameter: int) -> bool:
        """Return a parameter of the simulator that is true or false."""
        return bool(self._get_parameter("boolparam", bool, parameter, self._facts(), self._drawing_flags()))

    def setBoolParam(self, parameter: int, value: bool) -> None:
        """Set a parameter of the simulator; real time depends on the node's option --speed and cannot be changed."""
        if self._facts().get(parameter) == value:
            return
        if parameter == self.boolparam_realtime_simulation:
            raise ValueError("sim.boolparam_realtime_simulation cannot be changed: start the node with --speed")
        self._set_parameter("boolparam", bool, parameter, value, self._drawing_flags())

    def getStringParam(self, parameter: int) -> str:
        """Return sim.stringparam_application_path, scene_path, scene_name, scene_path_and_name or verbosity."""
        file = Path(self._simulation.scene_file)
        known = {
            self.stringparam_application_path: str(Path(__file__).parents[3]),
            self.stringparam_scene_path_and_name: str(file) if file.name else "",
            self.stringparam_scene_path: str(file.parent) if file.name else "",
            self.stringparam_scene_name: file.stem,
            self.stringparam_verbosity: self._verbosity(),
            self.stringparam_statusbarverbosity: "trace",
        }
        return str(self._get_parameter("stringparam", str, parameter, known, {}))

    def setStringParam(self, parameter: int, value: str) -> None:
        """Set sim.stringparam_verbosity: 'none', 'errors', 'warnings', 'scriptinfos', 'infos', 'debug' or 'trace'."""
        if parameter == self.stringparam_verbosity:
            self._set_verbosity(value)
            return
        self._set_parameter("stringparam", str, parameter, value, {})

    def getNamedStringParam(self, name: str) -> str | None:
        """Return a string that was set with setNamedStringParam; None (nil) if there is none."""
        text: str | None = self._caller.shared.settings.get((str, name))
        return text

    def setNamedStringParam(self, name: str, value: str) -> None:
        """Set a string by name, until the node ends."""
        self._caller.shared.settings[str, name] = value

    def getArrayParam(self, parameter: int) -> list[float]:
        """Return sim.arrayparam_gravity, m/s^2, or a colour of drawings."""
        known = {self.arrayparam_gravity: [float(number) for number in self._world.gravity]}
        numbers: list[float] = self._get_parameter("arrayparam", list, parameter, known, self._drawing_colours())
        return numbers

    def setArrayParam(self, parameter: int, value: Numbers) -> None:
        """Set sim.arrayparam_gravity, m/s^2, until the simulation is reset, or a colour of drawings."""
        if parameter == self.arrayparam_gravity:
            self._world.set_gravity([float(number) for number in value])
            return
        self._set_parameter("arrayparam", list, parameter, value, self._drawing_colours())

    def getObjectInt32Param(self, handle: Handle, parameter: int) -> int:
        """Return an integer parameter of an object: sim.jointintparam_dynctrlmode and jointintparam_motor_enabled of a
        joint, visionintparam_resolution_x and y of a camera, shapeintparam_static and shapeintparam_respondable of a
        model or link, proxintparam_entity_to_detect of a proximity sensor.

        The control modes of joints are sim.jointdynctrl_free, force, velocity and position.
        """
        handle = self._resolve(handle)
        if parameter == self.jointintparam_dynctrlmode:
            mode = self._world.motor_mode(handle)
            return next(number for number, known in self._control_modes().items() if known == mode)
        if parameter == self.jointintparam_motor_enabled:
            return int(self._control_modes()[self.jointdynctrl_free] != self._world.motor_mode(handle))
        if parameter == self.shapeintparam_static:
            return int(self._is_static(handle))
        if parameter == self.shapeintparam_respondable:
            return int(self._is_respondable(handle))
        if parameter in (self.visionintparam_resolution_x, self.visionintparam_resolution_y):
            return int(camera_optics(self._simulation, handle)[parameter - self.visionintparam_resolution_x])
        if parameter == self.proxintparam_entity_to_detect:
            self._world.sonar_limits(handle)  # raises
            return self._caller.shared.collections.detected.get(handle, self.handle_all)
        raise self._unknown("integer", parameter, "jointintparam_, visionintparam_, proxintparam_ or shapeintparam_")

    def setObjectInt32Param(self, handle: Handle, parameter: int, value: int) -> None:
        """Set sim.jointintparam_dynctrlmode, the control mode of a joint, or proxintparam_entity_to_detect, the object
        or collection that a proximity sensor detects, until the scene is reset; or of a model sim.shapeintparam_static
        (1: physics does not move it), of a created shape sim.shapeintparam_respondable."""
        if parameter in (self.shapeintparam_static, self.shapeintparam_respondable):
            change = self._set_static if parameter == self.shapeintparam_static else self._set_respondable
            change(self._resolve(handle), value != 0)
            return
        if parameter == self.proxintparam_entity_to_detect:
            self._set_entity_to_detect(self._resolve(handle), value)
            return
        if parameter != self.jointintparam_dynctrlmode:
            if self.getObjectInt32Param(handle, parameter) == value:
                return
            raise ValueError(
                f"parameter {parameter} cannot be set; settable: sim.jointintparam_dynctrlmode, "
                "proxintparam_entity_to_detect, shapeintparam_static and shapeintparam_respondable"
            )
        if value not in self._control_modes():
            raise ValueError(
                f"{value} is not a control mode of a joint; valid ones: sim.jointdynctrl_free, jointdynctrl_force, "
                "jointdynctrl_velocity and jointdynctrl_position"
            )
        self._world.set_motor_mode(self._resolve(handle), self._control_modes()[value])

    def getObjectFloatParam(self, handle: Handle, parameter: int) -> float:
        """Return a number of an object: sim.jointfloatparam_velocity and upper_limit, the angle of a camera
        sim.visionfloatparam_perspective_angle (rad), sim.objfloatparam_abs_x_velocity, y and z (m/s) and
        abs_rot_velocity (rad/s)."""
        handle = self._resolve(handle)
        if parameter == self.jointfloatparam_velocity:
            return float(self._world.joint_velocity(handle))
        if parameter == self.jointfloatparam_upper_limit:
            return float(self._world.joint_limits(handle)[1])
        if parameter == self.visionfloatparam_perspective_angle:
            return float(camera_optics(self._simulation, handle)[2])
        if self.objfloatparam_abs_x_velocity <= parameter <= self.objfloatparam_abs_rot_velocity:
            linear, angular = self._world.velocity(handle)
            return float([*linear, math.hypot(*angular)][parameter - self.objfloatparam_abs_x_velocity])
        raise self._unknown("number", parameter, "jointfloatparam_, visionfloatparam_ or objfloatparam_")

    def getModelProperty(self, handle: Handle) -> int:
        """Return 0 for a model, and sim.modelproperty_not_model for another object."""
        return 0 if self._world.is_model_base(self._resolve(handle)) else self.modelproperty_not_model

    def setModelProperty(self, handle: Handle, value: int) -> None:
        """Accept the value that the object has; others raise ValueError: parts of a model cannot be switched off."""
        if value != self.getModelProperty(handle):
            raise ValueError(
                f"the model property {value} is not supported: models are visible and dynamic as their file defines"
            )

    def _set_entity_to_detect(self, sensor: int, entity: int) -> None:
        self._world.sonar_limits(sensor)  # raises
        entity = self.handle_all if entity == -1 else entity  # old programs
        if not self._is_entity(entity):
            raise ValueError(f"{entity} is neither an object nor a collection nor sim.handle_all")
        self._caller.shared.collections.detected[sensor] = entity

    def _times(self) -> dict[int, float]:
        return {self.floatparam_simulation_time_step: float(self._simulation.time_step)}

    def _facts(self) -> dict[int, bool]:
        return {
            self.boolparam_realtime_simulation: math.isfinite(self._runner.speed),
            self.boolparam_headless: True,
            self.boolparam_dynamics_handling_enabled: True,
            self.boolparam_proximity_sensor_handling_enabled: True,
            self.boolparam_vision_sensor_handling_enabled: True,
        }

    def _drawing_flags(self) -> dict[int, bool]:
        names = (
            "hierarchy_visible console_visible browser_visible shape_textures_are_visible display_enabled "
            "infotext_visible statustext_open fog_enabled mirrors_enabled threaded_rendering_enabled fullscreen "
            "video_recording_triggered"
        )
        return {getattr(self, f"boolparam_{name}"): False for name in names.split()}

    def _drawing_integers(self) -> dict[int, int]:
        return {self.intparam_idle_fps: 8, self.intparam_visible_layers: 255, self.intparam_current_page: 0}

    def _drawing_colours(self) -> dict[int, list[float]]:
        numbers = (
            self.arrayparam_fog_color,
            self.arrayparam_background_color1,
            self.arrayparam_background_color2,
            self.arrayparam_ambient_light,
        )
        return {number: [0.0, 0.0, 0.0] for number in numbers}

    def _get_parameter(self, prefix: str, kind: type, parameter: int, known: Any, stored: Any) -> Any:
        if parameter in known:
            return known[parameter]
        if parameter in stored:
            return self._caller.shared.settings.get((kind, parameter), stored[parameter])
        raise self._unknown(prefix, parameter, f"{prefix}_")

    def _set_parameter(self, prefix: str, kind: type, parameter: int, value: Any, stored: Any) -> None:
        if parameter not in stored:
            raise ValueError(f"sim.{self._name(prefix, parameter)} cannot be set")
        self._caller.shared.settings[kind, parameter] = value

    def _name(self, prefix: str, parameter: int) -> str:
        names = [name for name in dir(self) if name.startswith(f"{prefix}_") and getattr(self, name) == parameter]
        return names[0] if names else f"{prefix} {parameter}"

    def _unknown(self, what: str, parameter: int, prefix: str) -> ValueError:
        return ValueError(
            f"the {what} parameter {parameter} is not supported: use a constant of sim that begins with {prefix}"
        )
