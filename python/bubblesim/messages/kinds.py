# SPDX-License-Identifier: BSD-3-Clause
"""What the words of a .msg file mean."""

from __future__ import annotations

# Spelling of a type in a .msg file -> its kind, as message_type.hpp and its kind_name() have it. Anything else names
# another message.
KINDS = {
    "bool": "bool",
    "int8": "int8",
    "byte": "int8",
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
    "time": "time",
    "duration": "duration",
}

HEADER = "std_msgs/Header"


def is_builtin(base_type: str) -> bool:
    """Whether a type has a kind of its own, in contrast to the messages made of such types."""
    return base_type in KINDS


def has_header(field_types: list[str]) -> bool:
    """Whether roscpp and rospy write the sequence number of such a message: a header comes first."""
    return bool(field_types) and field_types[0] == HEADER
