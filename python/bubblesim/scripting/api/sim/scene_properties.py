# SPDX-License-Identifier: BSD-3-Clause
"""The properties of the scene and of the simulator, by their names."""

from __future__ import annotations

import math
from typing import Any

from bubblesim.scripting.api.sim.property_kinds import Property


def _random_quaternion(sim: Any) -> list[float]:
    """Return a rotation of uniform distribution (Shoemake, "Uniform Random Rotations", 1992)."""
    size, first, second = sim.getRandom(), 2 * math.pi * sim.getRandom(), 2 * math.pi * sim.getRandom()
    near, far = math.sqrt(1 - size), math.sqrt(size)
    return [near * math.sin(first), near * math.cos(first), far * math.sin(second), far * math.cos(second)]


OF_SCENE: dict[str, Property] = {
    "gravity": Property(
        lambda sim, h: sim.getArrayParam(sim.arrayparam_gravity),
        lambda sim, h, v: sim.setArrayParam(sim.arrayparam_gravity, v),
    ),
    "simulationTime": Property(lambda sim, h: sim.getSimulationTime()),
    "simulationState": Property(lambda sim, h: sim.getSimulationState()),
    "timeStep": Property(lambda sim, h: sim.getSimulationTimeStep(), lambda sim, h, v: sim.setSimulationTimeStep(v)),
    "scenePath": Property(lambda sim, h: sim.getStringParam(sim.stringparam_scene_path_and_name)),
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
    "ambientLight": Property(
        lambda sim, h: sim.getArrayParam(sim.arrayparam_ambient_light),
        lambda sim, h, v: sim.setArrayParam(sim.arrayparam_ambient_light, v),
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
    "randomFloat": Property(lambda sim, h: sim.getRandom()),
    "randomQuaternion": Property(lambda sim, h: _random_quaternion(sim)),
}
