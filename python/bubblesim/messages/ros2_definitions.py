# SPDX-License-Identifier: BSD-3-Clause
"""Reads definitions of messages, services and actions as ROS 2 does; also those of ROS 1, for the types of both."""

from __future__ import annotations

import re
import struct
from dataclasses import dataclass, field
from typing import Any

from bubblesim.messages.kinds import COMMON_KINDS

# Spelling of a type in a .msg file -> its kind in message_type.hpp. Any other name is another message.
KINDS = COMMON_KINDS | {
    "byte": "uint8",
    "builtin_interfaces/Time": "time",
    "builtin_interfaces/Duration": "duration",
}
# ROS 1's spelling of types -> that of ROS 2.
_OF_ROS1 = {"time": "builtin_interfaces/Time", "duration": "builtin_interfaces/Duration", "Header": "std_msgs/Header"}
_BUILTIN = COMMON_KINDS.keys() | {"byte", "wstring"}

# Of the numbers.
_STRUCT_CODES = {
    "bool": "?",
    "byte": "B",
    "char": "B",
    "int8": "b",
    "uint8": "B",
    "int16": "h",
    "uint16": "H",
    "int32": "i",
    "uint32": "I",
    "int64": "q",
    "uint64": "Q",
    "float32": "f",
    "float64": "d",
}

_TYPE = re.compile(r"([A-Za-z]\w*(?:/[A-Za-z]\w*)*)(?:<=(\d+))?(?:(\[)(<=)?(\d*)\])?")
_CONSTANT = re.compile(r"\s*([A-Za-z]\w*)\s*=(.*)", re.DOTALL)


@dataclass(frozen=True)
class FieldType:
    """The type of a field."""

    base: str  # "float64", "wstring", "geometry_msgs/Point"
    is_array: bool = False
    length: int | None = None  # of a fixed array, or the most of a bounded one
    is_bounded: bool = False
    string_bound: int | None = None

    @property
    def is_builtin(self) -> bool:
        """Return whether it is no other message; times are messages."""
        return self.base in _BUILTIN

    @property
    def spelling(self) -> str:
        """Return the type as in a .msg file."""
        text = self.base if self.string_bound is None else f"{self.base}<={self.string_bound}"
        if not self.is_array:
            return text
        return f"{text}[{'<=' if self.is_bounded else ''}{'' if self.length is None else self.length}]"


@dataclass
class Ros2Message:
    """A message, or a part of a service or action: `std_srvs/SetBool_Request`, whose folder is "srv".

    Parts of actions have the folder "action" in their names: `test_msgs/action/Fibonacci_Goal`.
    """

    name: str
    folder: str = "msg"
    fields: list[tuple[str, FieldType]] = field(default_factory=list)
    constants: list[tuple[str, str, Any]] = field(default_factory=list)  # name, type, value
    defaults: dict[str, bytes] = field(default_factory=dict)  # by field, see messages::Field in message_type.hpp

    @property
    def full_name(self) -> str:
        """Return the name in ROS 2's spelling, `geometry_msgs/msg/Twist`."""
        package, _, short = self.name.partition("/")
        return self.name if "/" in short else f"{package}/{self.folder}/{short}"

    @property
    def text(self) -> str:
        """Return the definition, without comments."""
        constants = [f"{kind} {name}={_constant_text(kind, value)}" for name, kind, value in self.constants]
        return "".join(f"{line}\n" for line in [*constants, *(f"{kind.spelling} {name}" for name, kind in self.fields)])


class DefinitionError(ValueError):
    """A line that is not a field or constant; the message states which and why."""


def read_parts(text: str, name: str, folder: str) -> list[Ros2Message]:
    """Read a .msg, .srv or .action file: one message, two or three parts; name: theirs without their endings."""
    endings = {"msg": [""], "srv": ["_Request", "_Response"], "action": ["_Goal", "_Result", "_Feedback"]}[folder]
    parts = [Ros2Message(name + ending, folder) for ending in endings]
    at = 0
    for number, line in enumerate(text.split("\n"), start=1):
        if line.startswith("---"):
            at += 1
            if at == len(parts):
                raise DefinitionError(f"line {number}: a .{folder} file has {len(parts)} parts")
            continue
        try:
            _read_line(line, parts[at])
        except ValueError as error:
            raise DefinitionError(f"line {number}: {error}") from error
    if at + 1 != len(parts):
        raise DefinitionError(f"a .{folder} file has {len(parts)} parts, found {at + 1}")
    return parts


def _read_line(line: str, message: Ros2Message) -> None:
    words = line.partition("#")[0].split(None, 1)
    if not words:
        return
    kind = field_type(words[0], message.name.partition("/")[0])
    rest = words[1].strip() if len(words) > 1 else ""
    constant = _CONSTANT.fullmatch(rest)
    if constant and kind.is_builtin and not kind.is_array:
        whole = line.split(None, 1)[1].partition("=")[2]  # a '#' belongs to the value of a string
        message.constants.append((constant[1], kind.base, _value(kind.base, constant[2], whole)))
        return
    name, _, default = rest.partition(" ")
    if not re.fullmatch(r"[A-Za-z]\w*", name):
        raise ValueError(f"'{line.strip()}' is not a field: expected a type and a name")
    message.fields.append((name, kind))
    if default.strip():
        message.defaults[name] = _default(kind, line[line.index(default.strip()) :].strip())


def field_type(text: str, package: str) -> FieldType:
    """Read a type in a definition of a package."""
    match = _TYPE.fullmatch(text)
    if match is None:
        raise ValueError(f"'{text}' is not a type")
    base, string_bound, is_array, is_bounded, length = match.groups()
    base = _OF_ROS1.get(base, base).replace("/msg/", "/")
    if base not in _BUILTIN and "/" not in base:
        base = f"{package}/{base}"
    return FieldType(
        base,
        is_array is not None,
        int(length) if length else None,
        is_bounded is not None,
        int(string_bound) if string_bound else None,
    )


def _value(kind: str, text: str, whole: str) -> Any:
    if kind in ("string", "wstring"):
        value = whole.strip()
        return value[1:-1] if len(value) > 1 and value[0] == value[-1] and value[0] in "\"'" else value
    value = text.strip()
    if kind == "bool":
        return value.lower() in ("true", "1")
    if kind in ("float32", "float64"):
        return float(value)
    try:
        return int(value, 0)
    except ValueError:
        return int(value)  # 010


_STRINGS = re.compile(r"""\s*(?:"((?:[^"\\]|\\.)*)"|'((?:[^'\\]|\\.)*)')\s*(?:,|$|#)?""")


def _default(kind: FieldType, text: str) -> bytes:
    """Return the bytes of a default value, `1.5` or `[1, 2]`, which a comment may follow; those of 0 are empty."""
    if kind.base == "wstring":
        return b""  # types with it are refused elsewhere
    if not kind.is_builtin:
        raise ValueError(f"a {kind.base} has no default value, found '{text}'")
    if kind.is_array:
        if not text.startswith("["):
            raise ValueError(f"expected a list of default values, found '{text}'")
        text = text[1:].rpartition("]")[0]
    if kind.base == "string":
        quoted = [re.sub(r"\\(.)", r"\1", one or other) for one, other in _STRINGS.findall(text)]
        strings = quoted or [text.partition("#")[0].strip()]
        return b"".join(each.encode(errors="surrogateescape") + b"\0" for each in strings)
    values = [_value(kind.base, each, "") for each in text.partition("#")[0].split(",")]
    try:
        packed = struct.pack(f"<{len(values)}{_STRUCT_CODES[kind.base]}", *values)
    except (struct.error, OverflowError) as error:
        raise ValueError(f"default value '{text}' of a {kind.spelling}: {error}") from error
    return packed if any(packed) else b""


def _constant_text(kind: str, value: Any) -> str:
    if kind in ("string", "wstring"):
        return f'"{value}"'
    return str(value).lower() if isinstance(value, bool) else str(value)
