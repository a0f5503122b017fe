# SPDX-License-Identifier: BSD-3-Clause
"""Registers types that are not listed in the running process, from their definitions on this machine.

The compiled module calls add_message() and add_service() for unknown names.
"""

from __future__ import annotations

import sys
import threading
from pathlib import Path
from typing import Any

from bubblesim import _core
from bubblesim._core.messages import RosVersion
from bubblesim.messages.kinds import KINDS, has_header
from bubblesim.messages.names import did_you_mean, nearest_names, type_name
from bubblesim.messages.packages import PackageIndex, machine_index, project_root
from bubblesim.messages.ros2_definitions import KINDS as ROS2_KINDS
from bubblesim.messages.ros2_definitions import Ros2Message
from bubblesim.messages.ros2_specs import Ros2Specs, own_definitions
from bubblesim.messages.specs import SpecError, Specs

_lock = threading.Lock()
_added: set[tuple[str, str]] = set()  # kind, name


def add_message(name: str, version: _core.messages.RosVersion) -> None:
    """Add a message, or half of a service of ROS 1, with its nested types; raise MessageError if that fails."""
    _add(name, "msg", version)


def add_service(name: str, version: _core.messages.RosVersion) -> None:
    """Add a service with its nested types; raise MessageError if that fails."""
    _add(name, "srv", version)


def add_action(given_name: str) -> str:
    """Add the parts of an action of ROS 2; return the beginning of their names, `package/action/Type`.

    Raise MessageError if that fails.
    """
    name = type_name(given_name.replace("/action/", "/"))
    if name is None:
        raise _core.MessageError(
            f"'{given_name}' is not a type name, expected package/Name such as test_msgs/Fibonacci"
        )
    base = name.replace("/", "/action/")
    if ("action", name) in _added:
        return base
    specs = _ros2_specs(machine_index())
    try:
        specs.load_action(name)
    except SpecError as error:
        actions = {each.removesuffix("Goal") for each in specs.index.names("msg") if each.endswith("ActionGoal")}
        known = sorted({*specs.index.names("action"), *(each.removesuffix("Action") for each in actions)})
        raise _core.MessageError(f"{error}{did_you_mean(nearest_names(name, known))}") from error
    with _lock:
        _register_ros2(specs)
        _added.add(("action", name))
    return base


def _ros2_specs(index: PackageIndex) -> Ros2Specs:
    return Ros2Specs(index, own_definitions(before_iron=_core.messages.ros2_is_before_iron()))


def _add(given_name: str, kind: str, version: _core.messages.RosVersion) -> None:
    specs = Specs(machine_index())
    name = type_name(given_name)
    if name is None:
        hint = did_you_mean(_similar(specs, given_name, kind))
        expected = f"expected package/Type such as geometry_msgs/Twist{hint}"
        raise _core.MessageError(f"'{given_name}' is not a type name, {expected}")
    if version == _core.messages.RosVersion.ROS2:
        _add_of_ros2(_ros2_specs(specs.index), name, kind)
        return
    if kind == "msg" and not specs.index.find(name, "msg") and (service := _service_of_half(specs, name)):
        name, kind = service, "srv"
    if not specs.index.find(name, kind):
        raise _core.MessageError(_unknown(specs, name, kind))
    try:
        file = specs.load(name, kind)
    except SpecError as error:
        raise _core.MessageError(str(error)) from error
    with _lock:
        _register(specs)
        if (kind, name) not in _added:
            _added.add((kind, name))
            _report_unlisted(name, file)


def _add_of_ros2(specs: Ros2Specs, name: str, kind: str) -> None:
    what = "message" if kind == "msg" else "service"
    if not specs.find(name, kind):
        version = _core.messages.RosVersion.ROS2
        names = _core.messages.message_names if kind == "msg" else _core.messages.service_names
        hint = did_you_mean(nearest_names(name, sorted({*names(version), *specs.index.names(kind)})))
        raise _core.MessageError(
            f"{name} is not a {what} type of ROS 2 in this build, and no definition was found{hint}"
        )
    try:
        file = specs.load(name, kind)
    except SpecError as error:
        raise _core.MessageError(str(error)) from error
    with _lock:
        _register_ros2(specs)
        if (f"ROS 2 {kind}", name) not in _added:
            _added.add((f"ROS 2 {kind}", name))
            _report_unlisted(name, file)


def _register_ros2(specs: Ros2Specs) -> None:
    services = [
        (name, specs.service_hash(name), *(_ros2_tuple(specs, part) for part in parts))
        for name, parts in specs.services.items()
    ]
    _register_tuples([_ros2_tuple(specs, each) for each in specs.messages.values()], services, RosVersion.ROS2)


def _ros2_tuple(specs: Ros2Specs, message: Ros2Message) -> tuple[Any, ...]:
    fields = [
        (
            name,
            ROS2_KINDS.get(kind.base, kind.base),
            kind.is_array,
            None if kind.is_bounded else kind.length,
            (kind.length or 0 if kind.is_bounded else 0, kind.string_bound or 0),
            message.defaults.get(name, b""),
        )
        for name, kind in message.fields
    ]
    constants = [(name, ROS2_KINDS[kind], _bytes_of(value)) for name, kind, value in message.constants]
    definition = _bytes_of(specs.full_text(message))
    return message.name, specs.message_hash(message), definition, False, fields, constants


def _service_of_half(specs: Specs, name: str) -> str | None:
    """`std_srvs/SetBoolRequest` -> `std_srvs/SetBool`, if there is such a service."""
    for half in ("Request", "Response"):
        service = name.removesuffix(half)
        if service != name and specs.index.find(service, "srv"):
            return service
    return None


def _register(specs: Specs) -> None:
    messages = [_message_tuple(specs, spec) for spec in specs.messages.values()]
    services = [
        (name, specs.md5(spec), _message_tuple(specs, spec.request), _message_tuple(specs, spec.response))
        for name, spec in specs.services.items()
    ]
    _register_tuples(messages, services, RosVersion.ROS1)


def _register_tuples(messages: list[tuple[Any, ...]], services: list[tuple[Any, ...]], version: RosVersion) -> None:
    try:
        for message in messages:
            _core.messages.add_message(message, version)
        for service in services:
            _core.messages.add_service(*service, version)
    except ValueError as error:
        cure = "its definition has changed since bubblesim was built or started; rebuild: catkin build bubblesim"
        raise _core.MessageError(f"{error}: {cure}") from error


def _message_tuple(specs: Specs, spec: Any) -> tuple[Any, ...]:
    fields = [
        (f.name, KINDS.get(f.base_type, f.base_type), f.is_array, f.array_len, (0, 0), b"")
        for f in spec.parsed_fields()
    ]
    constants = [(c.name.strip(), KINDS[c.type], _bytes_of(c.val)) for c in spec.constants]
    definition = _bytes_of(specs.full_text(spec))
    return spec.full_name, specs.md5(spec), definition, has_header(spec.types), fields, constants


def _bytes_of(value: Any) -> Any:
    """Return strings as bytes, as in the file; return other values unchanged."""
    return value.encode("utf-8", errors="surrogateescape") if isinstance(value, str) else value


def _unknown(specs: Specs, name: str, kind: str) -> str:
    what, other = ("message", "service") if kind == "msg" else ("service", "message")
    if specs.index.find(name, "srv" if kind == "msg" else "msg"):
        return f"{name} is a {other} type, expected a {what} type"
    unknown = f"{name} is not a {what} type of this build, and no definition was found on this machine"
    if hint := did_you_mean(_similar(specs, name, kind)):
        return unknown + hint  # with a similar name, how to add the type is not useful
    if project_root() is None:
        return f"{unknown}; to add it, install its package, or source the setup.bash of the workspace that has it"
    return (
        f"{unknown}; to add it, install its package or add that to the workspace, and list it in "
        f"meta/{what}s.txt: rosrun bubblesim add_message {name}"
    )


def _similar(specs: Specs, name: str, kind: str) -> list[str]:
    listed = _core.messages.message_names() if kind == "msg" else _core.messages.service_names()
    return nearest_names(name, sorted({*listed, *specs.index.names(kind)}))


def _report_unlisted(name: str, file: Path) -> None:
    how = f". List it with: rosrun bubblesim add_message {name}" if project_root() else ""  # lists are of the sources
    print(f"info: {name} is not listed; using its definition from {file}{how}", file=sys.stderr, flush=True)
