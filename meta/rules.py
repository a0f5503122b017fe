# SPDX-License-Identifier: BSD-3-Clause
"""How message specifications become C++ tables: every decision of the generator that a template does not take."""

from __future__ import annotations

from dataclasses import dataclass

# Spelling in a .msg file -> FieldKind in message_type.hpp. Anything else names another message.
FIELD_KINDS = {
    "bool": "kBool",
    "int8": "kInt8",
    "byte": "kInt8",
    "uint8": "kUint8",
    "char": "kUint8",
    "int16": "kInt16",
    "uint16": "kUint16",
    "int32": "kInt32",
    "uint32": "kUint32",
    "int64": "kInt64",
    "uint64": "kUint64",
    "float32": "kFloat32",
    "float64": "kFloat64",
    "string": "kString",
    "time": "kTime",
    "duration": "kDuration",
}

HEADER = "std_msgs/Header"


@dataclass(frozen=True)
class FieldRow:
    """One line of a field table, each part spelled as C++."""

    name: str
    kind: str
    array: str
    length: int
    message: str


@dataclass(frozen=True)
class ConstantRow:
    """One line of a constant table, each part spelled as C++."""

    name: str
    kind: str
    value: str


def is_builtin(base_type: str) -> bool:
    """Whether a type has a kind of its own, in contrast to the messages made of such types."""
    return base_type in FIELD_KINDS


def cpp_string(text: str) -> str:
    """A C++ string literal, one source line for each line of the text so that tables stay readable."""
    lines = text.split("\n")
    pieces = [line + "\n" for line in lines[:-1]] + ([lines[-1]] if lines[-1] else [])
    return "\n    ".join(f'"{"".join(map(_escape, piece))}"' for piece in pieces) or '""'


def _escape(character: str) -> str:
    named = {"\\": "\\\\", '"': '\\"', "\n": "\\n", "\t": "\\t", "\r": "\\r"}
    if character in named:
        return named[character]
    # Always three octal digits: unlike \x, they end by themselves.
    return f"\\{ord(character):03o}" if ord(character) < 0x20 or ord(character) == 0x7F else character


def field_row(name: str, base_type: str, is_array: bool, array_length: int | None) -> FieldRow:
    """The table line of a field, for example ("covariance", "float64", True, 36)."""
    array = "kNone" if not is_array else "kVariable" if array_length is None else "kFixed"
    return FieldRow(
        name=cpp_string(name),
        kind=FIELD_KINDS.get(base_type, "kMessage"),
        array=array,
        length=array_length or 0,
        message="nullptr" if is_builtin(base_type) else cpp_string(base_type),
    )


def constant_row(name: str, base_type: str, value: bool | int | float | str) -> ConstantRow:
    """The table line of a constant; the value stays text, which loses nothing of 64-bit integers and doubles."""
    text = str(int(value)) if isinstance(value, bool) else repr(value) if isinstance(value, float) else str(value)
    return ConstantRow(name=cpp_string(name.strip()), kind=FIELD_KINDS[base_type], value=cpp_string(text))


def has_header(field_types: list[str]) -> bool:
    """Whether roscpp and rospy write the sequence number of such a message: a header comes first."""
    return bool(field_types) and field_types[0] == HEADER


def split_name(name: str) -> tuple[str, str]:
    """`geometry_msgs/Twist` -> ("geometry_msgs", "Twist")."""
    package, _, short = name.partition("/")
    return package, short
