# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that pack tables into bytes and unpack them."""

from __future__ import annotations

import struct
import sys
from typing import Any

import cbor2

from bubblesim.scripting.api.kinds import Bytes, Integers, Numbers
from bubblesim.scripting.api.sim.context import ApiContext


class PackFunctions(ApiContext):
    """Bytes are little-endian. ``start`` and ``count`` select numbers of a table; a count of 0 selects all the rest."""

    _most_unpacked = sys.maxsize
    """Numbers that a call can return."""

    def packTable(self, table: Any) -> bytes:
        """Return nested tables, strings, bytes and numbers as bytes (CBOR, RFC 8949)."""
        try:
            data: bytes = cbor2.dumps(table)
        except cbor2.CBOREncodeError as error:
            raise TypeError(f"sim.packTable: {error}") from None
        return data

    def unpackTable(self, data: Bytes) -> Any:
        """Return the data packed by packTable."""
        try:
            return cbor2.loads(data)
        except cbor2.CBORDecodeError as error:
            raise ValueError(f"sim.unpackTable: the bytes are not a packed table: {error}") from None

    def packUInt8Table(self, numbers: Integers, start: int = 0, count: int = 0) -> bytes:
        """Pack integers from 0 to 255 as one byte each."""
        return _pack("sim.packUInt8Table", "B", numbers, start, count)

    def unpackUInt8Table(self, data: Bytes, start: int = 0, count: int = 0, offset: int = 0) -> list[int]:
        """Unpack bytes, starting at byte ``offset``, as integers."""
        return self._unpack("sim.unpackUInt8Table", "B", data, start, count, offset)

    def packUInt16Table(self, numbers: Integers, start: int = 0, count: int = 0) -> bytes:
        """Pack integers from 0 to 65535 as 2 bytes each."""
        return _pack("sim.packUInt16Table", "H", numbers, start, count)

    def unpackUInt16Table(self, data: Bytes, start: int = 0, count: int = 0, offset: int = 0) -> list[int]:
        """Unpack integers of 2 bytes each without a sign, starting at byte ``offset``."""
        return self._unpack("sim.unpackUInt16Table", "H", data, start, count, offset)

    def packUInt32Table(self, numbers: Integers, start: int = 0, count: int = 0) -> bytes:
        """Pack integers without a sign as 4 bytes each."""
        return _pack("sim.packUInt32Table", "I", numbers, start, count)

    def unpackUInt32Table(self, data: Bytes, start: int = 0, count: int = 0, offset: int = 0) -> list[int]:
        """Unpack integers of 4 bytes each without a sign, starting at byte ``offset``."""
        return self._unpack("sim.unpackUInt32Table", "I", data, start, count, offset)

    def packInt32Table(self, numbers: Integers, start: int = 0, count: int = 0) -> bytes:
        """Pack integers as 4 bytes each."""
        return _pack("sim.packInt32Table", "i", numbers, start, count)

    def unpackInt32Table(self, data: Bytes, start: int = 0, count: int = 0, offset: int = 0) -> list[int]:
        """Unpack integers of 4 bytes each, starting at byte ``offset``."""
        return self._unpack("sim.unpackInt32Table", "i", data, start, count, offset)

    def packFloatTable(self, numbers: Numbers, start: int = 0, count: int = 0) -> bytes:
        """Pack numbers as 4 bytes each (IEEE 754 single precision)."""
        return _pack("sim.packFloatTable", "f", numbers, start, count)

    def unpackFloatTable(self, data: Bytes, start: int = 0, count: int = 0, offset: int = 0) -> list[float]:
        """Unpack numbers of 4 bytes each, starting at byte ``offset``."""
        return self._unpack("sim.unpackFloatTable", "f", data, start, count, offset)

    def packDoubleTable(self, numbers: Numbers, start: int = 0, count: int = 0) -> bytes:
        """Pack numbers as 8 bytes each (IEEE 754 double precision)."""
        return _pack("sim.packDoubleTable", "d", numbers, start, count)

    def unpackDoubleTable(self, data: Bytes, start: int = 0, count: int = 0, offset: int = 0) -> list[float]:
        """Unpack numbers of 8 bytes each, starting at byte ``offset``."""
        return self._unpack("sim.unpackDoubleTable", "d", data, start, count, offset)

    def _unpack(self, function: str, letter: str, data: bytes, start: int, count: int, offset: int) -> list[Any]:
        if not 0 <= offset <= len(data):
            raise ValueError(f"{function}: offset {offset} is outside the {len(data)} bytes")
        size = struct.calcsize(letter)
        there = (len(data) - offset) // size
        picked = _range(function, there, start, count)
        numbers = picked.stop - picked.start
        if numbers > self._most_unpacked:
            raise ValueError(f"{function}: {numbers} numbers: at most {self._most_unpacked}; unpack them in the client")
        return list(struct.unpack_from(f"<{numbers}{letter}", data, offset + picked.start * size))


def _pack(function: str, letter: str, numbers: list[Any], start: int, count: int) -> bytes:
    picked = numbers[_range(function, len(numbers), start, count)]
    try:
        return struct.pack(f"<{len(picked)}{letter}", *picked)
    except (struct.error, OverflowError) as error:
        raise ValueError(f"{function}: number out of range: {error}") from None


def _range(function: str, there: int, start: int, count: int) -> slice:
    end = start + count if count else there
    if not 0 <= start <= end <= there:
        raise ValueError(f"{function}: start {start} and count {count} exceed the {there} numbers")
    return slice(start, end)
