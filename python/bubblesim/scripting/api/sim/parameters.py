# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for parameters of the simulator, of objects and of models."""

from __future__ import annotations

import math
import os
import tempfile
from pathlib import Path
from typing import Any

from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.kinds import Numbers
from bubblesim.scripting.api.sim.logs import LogFunctions
from bubblesim.scripting.api.sim.object_parameters import ObjectParameterFunctions
from bubblesim.scripting.api.sim.random_numbers import RandomFunctions

_VERSION = 40700  # of the CoppeliaSim whose functions these are
_LINUX = 2
_ODE = 1


class ParameterFunctions(ObjectParameterFunctions, RandomFunctions, LogFunctions):
    """Parameters by their number, sim.intparam_program_version for example. Those without effect here, such as
    sim.boolparam_browser_visible and sim.intparam_idle_fps, keep what is set; they are 0, false or empty before.
    Numbers that no constant has raise a ValueError."""

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
            self.intparam_program_full_version: _VERSION * 100,
        }
        return int(self._get_parameter("intparam", int, parameter, known, self._drawing_integers()))

    def setInt32Param(self, parameter: int, value: int) -> None:
        """Set an integer parameter of the simulator."""
        self._set_parameter("intparam", int, parameter, value)

    def getFloatParam(self, parameter: int) -> float:
        """Return sim.floatparam_simulation_time_step (s) or floatparam_rand, a random number from 0 to 1."""
        if parameter == self.floatparam_rand:
            return self.getRandom()
        return float(self._get_parameter("floatparam", float, parameter, self._times(), {}))

    def setFloatParam(self, parameter: int, value: float) -> None:
        """Set sim.floatparam_simulation_time_step, s, until the simulation stops."""
        if parameter == self.floatparam_simulation_time_step:
            self._simulation.set_time_step(value)
        else:
            self._set_parameter("floatparam", float, parameter, value)

    def getBoolParam(self, parameter: int) -> bool:
        """Return a parameter of the simulator that is true or false."""
        return bool(self._get_parameter("boolparam", bool, parameter, self._facts(), self._drawing_flags()))

    @differs(
        "it switches real time, dynamics, sensors ...; here the node's option --speed sets the pace, and all is handled"
    )
    def setBoolParam(self, parameter: int, value: bool) -> None:
        """Set a parameter of the simulator; sim.boolparam_realtime_simulation, and what is handled, stay as they are,
        with a warning: real time depends on the node's option --speed."""
        facts = self._facts()
        if parameter in facts:
            if facts[parameter] != value:
                self.addLog(
                    self.verbosity_scriptwarnings | self.verbosity_once,
                    f"sim.{self._name('boolparam', parameter)} stays {facts[parameter]}: see the node's option --speed",
                )
            return
        self._set_parameter("boolparam", bool, parameter, value)

    def getStringParam(self, parameter: int) -> str:
        """Return sim.stringparam_application_path, scene_path, scene_name, scene_path_and_name, scenedefaultdir,
        modeldefaultdir, tempdir or verbosity."""
        file = Path(self._simulation.scene_file)
        folder = str(file.parent) if file.name else ""
        known = {
            self.stringparam_application_path: str(Path(__file__).parents[3]),
            self.stringparam_scene_path_and_name: str(file) if file.name else "",
            self.stringparam_scene_path: folder,
            self.stringparam_scenedefaultdir: folder,
            self.stringparam_modeldefaultdir: str(file.parent / "models") if file.name else "",
            self.stringparam_tempdir: tempfile.gettempdir(),
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
        self._set_parameter("stringparam", str, parameter, value)

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
        self._set_parameter("arrayparam", list, parameter, value)

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
        if parameter not in stored and not self._name(prefix, parameter):
            raise ValueError(f"there is no {prefix} {parameter}: use a constant of sim that begins with {prefix}_")
        return self._caller.shared.settings.get((kind, parameter), stored.get(parameter, kind()))

    def _set_parameter(self, prefix: str, kind: type, parameter: int, value: Any) -> None:
        if not self._name(prefix, parameter):
            raise ValueError(f"there is no {prefix} {parameter}: use a constant of sim that begins with {prefix}_")
        self._caller.shared.settings[kind, parameter] = value

    def _name(self, prefix: str, parameter: int) -> str:
        """Return the name of a parameter; empty if there is none."""
        names = [name for name in dir(self) if name.startswith(f"{prefix}_") and getattr(self, name) == parameter]
        return names[0] if names else ""
