# SPDX-License-Identifier: BSD-3-Clause
"""Types in .msg files."""

from __future__ import annotations

# Spelling of a type in a .msg file -> its kind, as in message_type.hpp and its kind_name(). Those of ROS 1 and ROS 2:
COMMON_KINDS = {
    "bool": "bool",
    "int8": "int8",
    "uint8": "uint8",
    "char": "uint8",
    "int16": "int16",
    "uint16": "uint16",
    "int32": "int32",
    "uint32": "uint32",
    "int64": "int64",
    "uint64": "uint64",
    "float32": "float32",
    "float64": "float64",
    "string": "string",
}
# Those of ROS 1. Any other name is another message.
KINDS = COMMON_KINDS | {"byte": "int8", "time": "time", "duration": "duration"}

HEADER = "std_msgs/Header"


def is_builtin(base_type: str) -> bool:
    """Return whether a type is a builtin type, not a message."""
    return base_type in KINDS


def has_header(field_types: list[str]) -> bool:
    """Return whether roscpp and rospy write the sequence number of such a message: its first field is a header."""
    return bool(field_types) and field_types[0] == HEADER
