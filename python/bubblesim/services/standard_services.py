# SPDX-License-Identifier: BSD-3-Clause
"""The services of ROS 2's standard for simulators: the package simulation_interfaces, at the top of the names.

Entities are models. The bridge itself offers /step_simulation, which answers later; the action /simulate_steps is in
``simulate_steps.py``.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from enum import IntEnum
from pathlib import Path
from urllib.parse import unquote, urlsplit

from bubblesim import _core
from bubblesim._core import RunState, SceneError
from bubblesim.geometry.frames import state_from, state_in
from bubblesim.ros_messages import pose_message, pose_values, twist_message, vector_values
from bubblesim.scripting.host.host import ScriptHost
from bubblesim.services.answers import Message
from bubblesim.services.gazebo_names import find_entity, find_frame

_MODEL_NAME = re.compile(r"<(?:model|robot)\b[^>]*?\sname\s*=\s*[\"']([^\"']*)", re.DOTALL)
_FORMATS = {".sdf", ".urdf", ".world"}


class Code(IntEnum):
    """The constants of Result, SetSimulationState and SpawnEntity that are used."""

    FEATURE_UNSUPPORTED = 0
    OK = 1
    NOT_FOUND = 2
    OPERATION_FAILED = 4
    ALREADY_IN_TARGET_STATE = 101
    INCORRECT_TRANSITION = 103
    NAME_NOT_UNIQUE = 101
    UNSUPPORTED_FORMAT = 103
    NO_RESOURCE = 104
    RESOURCE_PARSE_ERROR = 106
    INVALID_POSE = 109


class State(IntEnum):
    """The constants of SimulationState."""

    STOPPED = 0
    PLAYING = 1
    PAUSED = 2
    QUITTING = 3


class Scope(IntEnum):
    """The bits of ResetSimulation."""

    TIME = 1
    STATE = 2
    SPAWNED = 4
    ALL = 255


# The constants of SimulatorFeatures.
_FEATURES = {
    "SPAWNING": 0,
    "DELETING": 1,
    "SPAWNING_RESOURCE_STRING": 9,
    "ENTITY_STATE_GETTING": 10,
    "ENTITY_STATE_SETTING": 11,
    "SIMULATION_RESET": 20,
    "SIMULATION_RESET_TIME": 21,
    "SIMULATION_RESET_STATE": 22,
    "SIMULATION_RESET_SPAWNED": 23,
    "SIMULATION_STATE_GETTING": 24,
    "SIMULATION_STATE_SETTING": 25,
    "SIMULATION_STATE_PAUSE": 26,
    "STEP_SIMULATION_SINGLE": 31,
    "STEP_SIMULATION_MULTIPLE": 32,
}
_STEP_SIMULATION_ACTION = 33

_STATES = {
    RunState.STOPPED: State.STOPPED,
    RunState.RUNNING: State.PLAYING,
    RunState.STOPPING: State.PLAYING,
    RunState.PAUSED: State.PAUSED,
}


class RefusedError(Exception):
    """A request is not carried out, for a reason that has a code."""

    def __init__(self, code: Code, why: str) -> None:
        """Keep the code."""
        super().__init__(why)
        self.code = code


class StandardServices:
    """Advertised during the lifetime of the host's bridge."""

    def __init__(self, host: ScriptHost, *, has_action: bool) -> None:
        """Advertise the services; ``has_action``: /simulate_steps is there, too."""
        assert host.bridge is not None
        self._host = host
        self._simulation = host.simulation
        self._world = host.simulation.world
        self._runner = host.runner
        self._spawned: set[int] = set()
        self._features = [*_FEATURES.values(), *([_STEP_SIMULATION_ACTION] if has_action else [])]
        servers = {
            name: host.bridge.advertise_service(
                f"/{name}", f"simulation_interfaces/{kind}", answer, _core.messages.TimeForm.FLOAT
            )
            for name, kind, answer in (
                ("get_simulator_features", "GetSimulatorFeatures", self._get_features),
                ("get_simulation_state", "GetSimulationState", _with_result(self._get_state)),
                ("set_simulation_state", "SetSimulationState", _with_result(self._set_state)),
                ("reset_simulation", "ResetSimulation", _with_result(self._reset)),
                ("get_entities", "GetEntities", _with_result(self._get_entities)),
                ("get_entities_states", "GetEntitiesStates", _with_result(self._get_entities_states)),
                ("get_entity_state", "GetEntityState", _with_result(self._get_entity_state)),
                ("set_entity_state", "SetEntityState", _with_result(self._set_entity_state)),
                ("spawn_entity", "SpawnEntity", _with_result(self._spawn)),
                ("delete_entity", "DeleteEntity", _with_result(self._delete)),
            )
        }
        for name in ("set_simulation_state", "reset_simulation"):
            host.bridge.set_priority(servers[name])  # they end a script that does not return

    def _get_features(self, _: Message) -> Message:
        features = {"features": self._features, "spawn_formats": ["sdf", "urdf"], "custom_info": "bubblesim"}
        return {"features": features}

    def _get_state(self, _: Message) -> Message:
        return {"state": {"state": int(_STATES[self._runner.state])}}

    def _set_state(self, request: Message) -> Message:
        wanted = request["state"]["state"]
        now = _STATES[self._runner.state]
        if wanted not in list(State):
            raise RefusedError(
                Code.FEATURE_UNSUPPORTED, f"there is no state {wanted}: 0 is stopped, 1 playing, 2 paused"
            )
        if wanted == now:
            raise RefusedError(Code.ALREADY_IN_TARGET_STATE, f"the simulation is {now.name.lower()} already")
        if wanted == State.PAUSED and now == State.STOPPED:
            raise RefusedError(Code.INCORRECT_TRANSITION, "a stopped simulation cannot be paused: play it first")
        actions = {
            State.STOPPED: self._runner.stop,
            State.PLAYING: self._runner.start,
            State.PAUSED: self._runner.pause,
            State.QUITTING: self._runner.end,
        }
        actions[State(wanted)](wait=False)
        return {}

    def _reset(self, request: Message) -> Message:
        scope = request["scope"] or Scope.ALL
        if scope & Scope.TIME and not scope & Scope.STATE:
            raise RefusedError(Code.FEATURE_UNSUPPORTED, "the time is reset with the state only: add 2 to the scope")
        if scope & Scope.TIME:
            self._host.restart()
        elif scope & Scope.STATE:
            self._simulation.reset_world()
        if scope & Scope.SPAWNED:
            for model in self._spawned & set(self._world.models):
                self._host.remove_model(model)
            self._spawned.clear()
        return {}

    def _models(self, filters: Message) -> list[int]:
        if filters["categories"] or filters["tags"]["tags"] or len(filters["bounds"]["points"]) > 0:
            raise RefusedError(Code.FEATURE_UNSUPPORTED, "entities are filtered by their names only")
        try:
            pattern = re.compile(filters["filter"])
        except re.error as error:
            raise ValueError(f"'{filters['filter']}' is not a regular expression: {error}") from None
        return [model for model in self._world.models if pattern.search(self._world.name(model))]

    def _get_entities(self, request: Message) -> Message:
        return {"entities": [self._world.name(model) for model in self._models(request["filters"])]}

    def _get_entities_states(self, request: Message) -> Message:
        models = self._models(request["filters"])
        return {
            "entities": [self._world.name(model) for model in models],
            "states": [self._state(model) for model in models],
        }

    def _get_entity_state(self, request: Message) -> Message:
        return {"state": self._state(self._model(request["entity"]))}

    def _set_entity_state(self, request: Message) -> Message:
        model, state = self._model(request["entity"]), request["state"]
        linear, angular = (vector_values(state["twist"][part]) for part in ("linear", "angular"))
        frame = find_frame(self._world, state["header"]["frame_id"])
        if any([*linear, *angular]) and self._world.is_static(model):
            raise ValueError(f"'{request['entity']}' is static: it has no velocity")
        self._world.set_state(model, *state_from(self._world, pose_values(state["pose"]), linear, angular, frame))
        return {}

    def _spawn(self, request: Message) -> Message:
        text = _read(request["uri"]) if request["uri"] else request["resource_string"]
        if not text:
            raise RefusedError(Code.NO_RESOURCE, "the request has neither a uri nor a resource_string")
        pose = pose_values(request["initial_pose"]["pose"])
        if not (all(map(math.isfinite, pose)) and 0.9 < math.hypot(*pose[3:]) < 1.1):
            raise RefusedError(Code.INVALID_POSE, f"initial_pose: {pose[3:]} is no quaternion; the identity is w: 1.0")
        frame = find_frame(self._world, request["initial_pose"]["header"]["frame_id"])
        if frame is not None:
            pose = self._world.pose_from(pose, frame)
        namespace = request["entity_namespace"]
        try:
            model = self._simulation.add_model(
                text,
                name=self._free_name(request["name"] or _name_in(text), renaming=request["allow_renaming"]),
                position=pose[:3],
                orientation=pose[3:],
                plugin_parameters={"robotNamespace": namespace} if namespace else {},
            )
        except SceneError as error:
            raise RefusedError(Code.RESOURCE_PARSE_ERROR, str(error)) from None
        self._spawned.add(model.handle)
        return {"entity_name": model.name}

    def _delete(self, request: Message) -> Message:
        self._host.remove_model(self._model(request["entity"]))
        return {}

    def _model(self, name: str) -> int:
        return find_entity(self._world, name, "model")

    def _state(self, model: int) -> Message:
        pose, linear, angular = state_in(self._world, model, None)
        return {
            "header": {"stamp": self._simulation.state_time, "frame_id": "world"},
            "pose": pose_message(pose),
            "twist": twist_message(linear, angular),
        }

    def _free_name(self, name: str, *, renaming: bool) -> str:
        """Return the name of a new model, with a number if it is taken and may be changed."""
        taken = {self._world.name(model) for model in self._world.models}
        if name not in taken:
            return name
        if not renaming:
            raise RefusedError(Code.NAME_NOT_UNIQUE, f"there is a model '{name}' already; allow_renaming adds a number")
        number = 1
        while f"{name}_{number}" in taken:
            number += 1
        return f"{name}_{number}"


def _with_result(answer: Callable[[Message], Message]) -> Callable[[Message], Message]:
    """Report errors in the response's field result."""

    def guarded(request: Message) -> Message:
        try:
            return {"result": {"result": int(Code.OK)}, **answer(request)}
        except RefusedError as refused:
            return {"result": {"result": int(refused.code), "error_message": str(refused)}}
        except LookupError as error:
            return {"result": {"result": int(Code.NOT_FOUND), "error_message": str(error)}}
        except (ValueError, RuntimeError) as error:
            return {"result": {"result": int(Code.OPERATION_FAILED), "error_message": str(error)}}

    return guarded


def _name_in(text: str) -> str:
    """Return the name of the first model in an SDFormat or URDF document, "" without one."""
    found = _MODEL_NAME.search(text)
    return found[1] if found else ""


def _read(uri: str) -> str:
    """Return the text of the file that a URI or a path names; `model://NAME` is searched in the folders of models."""
    parts = urlsplit(uri)
    if parts.scheme == "model":
        name = parts.netloc + parts.path
        places = [Path(folder) / "models" / name / "model.sdf" for folder in _core.scene_folders()]
        file = next((place for place in places if place.is_file()), None)
        if file is None:
            raise RefusedError(Code.NO_RESOURCE, f"{uri}: there is no {' or '.join(map(str, places))}")
    elif parts.scheme in ("", "file"):
        file = Path(unquote(parts.path))
    else:
        raise RefusedError(Code.UNSUPPORTED_FORMAT, f"{uri}: expected a file, file:// or model://")
    if file.suffix not in _FORMATS:
        raise RefusedError(Code.UNSUPPORTED_FORMAT, f"{uri}: expected a file that ends with .sdf or .urdf")
    try:
        return file.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise RefusedError(Code.NO_RESOURCE, f"{uri}: {error}") from None
