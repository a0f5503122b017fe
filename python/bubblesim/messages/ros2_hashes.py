# SPDX-License-Identifier: BSD-3-Clause
"""ROS 2's hashes of types, RIHS01 (REP 2016): SHA-256 of a description of the fields as JSON."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable
from typing import Any

from bubblesim.messages.ros2_definitions import FieldType, Ros2Message

# type_description_interfaces/msg/FieldType
_IDS = {
    "int8": 2,
    "uint8": 3,
    "char": 3,
    "int16": 4,
    "uint16": 5,
    "int32": 6,
    "uint32": 7,
    "int64": 8,
    "uint64": 9,
    "float32": 10,
    "float64": 11,
    "bool": 15,
    "byte": 16,
    "string": 17,
    "wstring": 18,
}
_NESTED = 1
_BOUNDED_STRING = 4  # added to the ids of strings
_FIXED, _BOUNDED, _UNBOUNDED = 48, 96, 144  # added for arrays

Find = Callable[[str], Ros2Message]
Description = dict[str, Any]

_EMPTY = ("structure_needs_at_least_one_member", FieldType("uint8"))
_EVENT_INFO = Ros2Message(
    "service_msgs/ServiceEventInfo",
    fields=[
        ("event_type", FieldType("uint8")),
        ("stamp", FieldType("builtin_interfaces/Time")),
        ("client_gid", FieldType("char", is_array=True, length=16)),
        ("sequence_number", FieldType("int64")),
    ],
)


def message_hash(message: Ros2Message, find: Find) -> str:
    """Return the hash; ``find`` returns the messages in its fields by `package/Type`."""
    return _hash(_description(message, find), _nested(message.fields, find))


def service_hash(name: str, request: Ros2Message, response: Ros2Message, find: Find) -> str:
    """Return the hash of a service `package/Type`."""
    event = Ros2Message(
        f"{name}_Event",
        request.folder,
        [
            ("info", FieldType(_EVENT_INFO.name)),
            ("request", FieldType(request.name, is_array=True, length=1, is_bounded=True)),
            ("response", FieldType(response.name, is_array=True, length=1, is_bounded=True)),
        ],
    )
    parts = {part.name: part for part in (request, response, event, _EVENT_INFO)}

    def find_part(wanted: str) -> Ros2Message:
        return parts.get(wanted) or find(wanted)

    fields = [(f"{label}_message", FieldType(part.name)) for label, part in _labelled(request, response, event)]
    service = Ros2Message(name, request.folder, fields)
    return _hash(_description(service, find_part), _nested(fields, find_part))


def _labelled(*parts: Ros2Message) -> Iterable[tuple[str, Ros2Message]]:
    return zip(("request", "response", "event"), parts, strict=True)


def _hash(description: Description, nested: dict[str, Description]) -> str:
    whole = {
        "type_description": description,
        "referenced_type_descriptions": [nested[name] for name in sorted(nested)],
    }
    return "RIHS01_" + hashlib.sha256(json.dumps(whole, separators=(", ", ": ")).encode()).hexdigest()


def _description(message: Ros2Message, find: Find) -> Description:
    fields = message.fields or [_EMPTY]
    return {
        "type_name": message.full_name,
        "fields": [{"name": name, "type": _type(kind, find)} for name, kind in fields],
    }


def _type(kind: FieldType, find: Find) -> Description:
    number = _IDS[kind.base] if kind.is_builtin else _NESTED
    if kind.string_bound is not None:
        number += _BOUNDED_STRING
    if kind.is_array:
        number += _BOUNDED if kind.is_bounded else _UNBOUNDED if kind.length is None else _FIXED
    return {
        "type_id": number,
        "capacity": kind.length or 0,
        "string_capacity": kind.string_bound or 0,
        "nested_type_name": "" if kind.is_builtin else find(kind.base).full_name,
    }


def _nested(fields: Iterable[tuple[str, FieldType]], find: Find) -> dict[str, Description]:
    """Return the descriptions of all messages inside, by their full names."""
    found: dict[str, Description] = {}
    waiting = [kind.base for _, kind in fields if not kind.is_builtin]
    while waiting:
        message = find(waiting.pop())
        if message.full_name not in found:
            found[message.full_name] = _description(message, find)
            waiting += [kind.base for _, kind in message.fields if not kind.is_builtin]
    return found
