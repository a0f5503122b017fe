# SPDX-License-Identifier: BSD-3-Clause
"""Reads the messages of an MCAP file that the node has recorded: without compression and chunks, see mcap_file.py."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from bubblesim import _core

_MAGIC_BYTES = 8
_SCHEMA, _CHANNEL, _MESSAGE, _DATA_END = 3, 4, 5, 15
_RECORD = struct.Struct("<BQ")  # kind, bytes of its content
_NUMBER = struct.Struct("<H")
_LENGTH = struct.Struct("<I")
_MESSAGE_HEADER = struct.Struct("<HIQQ")  # channel, sequence number, two times in ns
_CDR_HEADER_BYTES = 4


def read_messages(file: Path, topic: str) -> Iterator[tuple[str, Any, float]]:
    """Yield type, message and time [s] of each message on a topic, in the order of the file."""
    types: dict[int, str] = {}  # by number of the schema
    channels: dict[int, str] = {}  # types by number of the channel, of this topic
    for kind, content in _records(file.read_bytes()):
        if kind == _SCHEMA:
            types[_NUMBER.unpack_from(content)[0]] = _text(content, 2)
        elif kind == _CHANNEL and _text(content, 4) == topic:
            number, schema = struct.unpack_from("<HH", content)
            channels[number] = types[schema]
        elif kind == _MESSAGE:
            number, _, nanoseconds, _ = _MESSAGE_HEADER.unpack_from(content)
            if number in channels:
                data = content[_MESSAGE_HEADER.size + _CDR_HEADER_BYTES :]
                decoded = _core.messages.decode_ros2(channels[number], data, _core.messages.TimeForm.SEC_NANOSEC)
                yield channels[number], _with_attributes(decoded), nanoseconds / 1e9


def _records(data: bytes) -> Iterator[tuple[int, bytes]]:
    at = _MAGIC_BYTES
    while at + _RECORD.size <= len(data):
        kind, size = _RECORD.unpack_from(data, at)
        at += _RECORD.size
        if kind == _DATA_END:
            return
        yield kind, data[at : at + size]
        at += size


def _text(content: bytes, at: int) -> str:
    begin = at + _LENGTH.size
    return content[begin : begin + _LENGTH.unpack_from(content, at)[0]].decode()


def _with_attributes(value: Any) -> Any:
    if isinstance(value, dict):
        return SimpleNamespace(**{name: _with_attributes(each) for name, each in value.items()})
    if isinstance(value, list):
        return [_with_attributes(each) for each in value]
    return value
