# SPDX-License-Identifier: BSD-3-Clause
"""Convert message specifications to the rows of C++ tables; the templates only print them."""

from __future__ import annotations

from dataclasses import dataclass

from bubblesim.messages import ros2_definitions
from bubblesim.messages.kinds import KINDS, is_builtin

# Spelling in a .msg file -> FieldKind in message_type.hpp.
FIELD_KINDS = {spelling: f"k{kind.capitalize()}" for spelling, kind in KINDS.items()}


@dataclass(frozen=True)
class FieldRow:
    """One row of a field table, as C++ code."""

    name: str
    kind: str
    array: str
    length: int
    message: str
    default: str = "{}"
    bound: int = 0
    string_bound: int = 0


@dataclass(frozen=True)
class ConstantRow:
    """One row of a constant table, as C++ code."""

    name: str
    kind: str
    value: str


def cpp_string(text: str) -> str:
    """Return a C++ string literal, with one source line for each line of the text."""
    lines = text.split("\n")
    pieces = [line + "\n" for line in lines[:-1]] + ([lines[-1]] if lines[-1] else [])
    return "\n    ".join(f'"{"".join(map(_escape, piece))}"' for piece in pieces) or '""'


def _escape(character: str) -> str:
    named = {"\\": "\\\\", '"': '\\"', "\n": "\\n", "\t": "\\t", "\r": "\\r"}
    if character in named:
        return named[character]
    # Always three octal digits: unlike \x, the escape sequence has a fixed length.
    return f"\\{ord(character):03o}" if ord(character) < 0x20 or ord(character) == 0x7F else character


def field_row(name: str, base_type: str, is_array: bool, array_length: int | None) -> FieldRow:
    """Return the row of a field, for example ("covariance", "float64", True, 36)."""
    array = "kNone" if not is_array else "kVariable" if array_length is None else "kFixed"
    return FieldRow(
        name=cpp_string(name),
        kind=FIELD_KINDS.get(base_type, "kMessage"),
        array=array,
        length=array_length or 0,
        message="nullptr" if is_builtin(base_type) else cpp_string(base_type),
    )


def ros2_field_row(name: str, kind: ros2_definitions.FieldType, default: bytes) -> FieldRow:
    """Return the row of a field of a type of ROS 2."""
    array = "kNone" if not kind.is_array else "kVariable" if kind.length is None or kind.is_bounded else "kFixed"
    builtin = ros2_definitions.KINDS.get(kind.base)
    return FieldRow(
        name=cpp_string(name),
        kind=FIELD_KINDS[builtin] if builtin else "kMessage",
        array=array,
        length=kind.length or 0 if array == "kFixed" else 0,
        bound=kind.length or 0 if kind.is_bounded else 0,
        string_bound=kind.string_bound or 0,
        message="nullptr" if builtin else cpp_string(kind.base),
        default=_string_view(default) if default else "{}",
    )


def _string_view(data: bytes) -> str:
    octal = "".join(f"\\{byte:03o}" for byte in data)
    return f'std::string_view("{octal}", {len(data)})'


def ros2_constant_row(name: str, base_type: str, value: bool | int | float | str) -> ConstantRow:
    """Return the row of a constant of a type of ROS 2."""
    return constant_row(name, ros2_definitions.KINDS[base_type], value)


def constant_row(name: str, base_type: str, value: bool | int | float | str) -> ConstantRow:
    """Return the row of a constant; the value stays text to keep the precision of 64-bit integers and doubles."""
    text = str(int(value)) if isinstance(value, bool) else repr(value) if isinstance(value, float) else str(value)
    return ConstantRow(name=cpp_string(name.strip()), kind=FIELD_KINDS[base_type], value=cpp_string(text))
