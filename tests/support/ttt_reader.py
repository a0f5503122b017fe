# SPDX-License-Identifier: BSD-3-Clause
"""A second reader of CoppeliaSim's files, for tests: the tree, poses and masses, straight from the bytes."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

_MARKERS = (b"EOO", b"NXT", b"EOF")
_KINDS = b"SHP JNT DMY SNR RSN FSE CMA LGT SCT GRH PAT MIL MIR OCT PTC MKR CSO".split()
_HEADER = 1021


@dataclass
class FileObject:
    """An object as the file has it."""

    kind: str
    handle: int
    parent: int
    name: str
    order: int
    frame: np.ndarray
    """4 x 4, relative to the moving frame of the parent."""
    motion: np.ndarray
    """From its frame to that of its children."""
    mass: float | None
    """Of a shape that is not static, kg."""
    children: list[FileObject] = field(default_factory=list)


def roots(file: Path) -> list[FileObject]:
    """Return the objects at the top, with those below them in their order."""
    objects = {each.handle: each for each in _objects(_content(file.read_bytes()))}
    top = []
    for each in objects.values():
        parent = objects.get(each.parent)
        (top if parent is None else parent.children).append(each)
    for siblings in [top, *(each.children for each in objects.values())]:
        siblings.sort(key=lambda each: each.order)
    return top


def _content(data: bytes) -> bytes:
    packed, size = struct.unpack_from("<Bi", data, 12)
    return _unpack(data[_HEADER:], size) if packed else data[_HEADER:]


def _unpack(data: bytes, size: int) -> bytes:
    """Undo the Huffman code: the tree in preorder, then the codes, most significant bits first."""
    bits = "".join(f"{byte:08b}" for byte in data[:2000])
    codes: dict[str, int] = {}
    place, open_codes = 0, [""]
    while open_codes:
        code = open_codes.pop()
        if bits[place] == "1":
            codes[code] = int(bits[place + 1 : place + 9], 2)
            place += 9
        else:
            open_codes += [code + "1", code + "0"]
            place += 1
    longest = max(map(len, codes))
    table: list[tuple[int, int]] = [(0, 0)] * (1 << longest)
    for code, value in codes.items():
        first = int(code or "0", 2) << (longest - len(code))
        table[first : first + (1 << (longest - len(code)))] = [(value, len(code) or 1)] * (1 << (longest - len(code)))
    out = bytearray(size)
    window = int.from_bytes(data[place // 8 : place // 8 + 8], "big")
    left, after = 64 - place % 8, place // 8 + 8
    window &= (1 << left) - 1
    for i in range(size):
        if left < longest:
            window = window << 64 | int.from_bytes(data[after : after + 8].ljust(8, b"\0"), "big")
            left, after = left + 64, after + 8
        out[i], length = table[window >> (left - longest)]
        left -= length
        window &= (1 << left) - 1
    return bytes(out)


def _items(data: bytes) -> Iterator[tuple[bytes, bytes]]:
    """Yield the tags and contents of a list; the rest after its end under the tag of the end."""
    place = 0
    while place < len(data):
        tag = data[place : place + 3]
        if tag in _MARKERS:
            yield tag, data[place + 3 :]
            return
        (length,) = struct.unpack_from("<i", data, place + 3)
        yield tag, data[place + 7 : place + 7 + length]
        place += 7 + length


def _objects(content: bytes) -> Iterator[FileObject]:
    for tag, data in _items(content):
        if tag not in _KINDS:
            continue
        common = dict(_items(data))
        own = dict(_items(common[b"NXT"]))
        handle, parent = struct.unpack_from("<2i", common[b"Ids"])
        numbers = struct.unpack("<7d", common[b"_fq"]) if b"_fq" in common else struct.unpack("<7f", common[b"Cfq"])
        name = common.get(b"Ali", common.get(b"Nme", b"\0\0\0\0"))[4:].decode(errors="replace").split("#")[0]
        order = struct.unpack("<i", common[b"Cor"])[0] if b"Cor" in common else -1
        kind = tag.decode()
        motion = _motion(own) if kind == "JNT" else np.eye(4)
        flags = struct.unpack("<i", common[b"Mpo"])[0] if b"Mpo" in common else 0
        mass = _mass(own) if kind == "SHP" and own[b"Sss"][0] & 0x80 and not flags & 0x20 else None
        yield FileObject(kind, handle, parent, name, order, _matrix(numbers[:4], numbers[4:]), motion, mass)


def _matrix(rotation: tuple[float, ...], position: tuple[float, ...] = (0, 0, 0)) -> np.ndarray:
    """Return a transformation; the quaternion is w x y z, of any length."""
    w, x, y, z = np.array(rotation) / np.linalg.norm(rotation)
    made = np.eye(4)
    made[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    made[:3, 3] = position
    return made


def _number(own: dict[bytes, bytes], floats: bytes, doubles: bytes) -> float:
    if doubles in own:
        return float(struct.unpack_from("<d", own[doubles])[0])
    return float(struct.unpack_from("<f", own[floats])[0]) if floats in own else 0.0


def _motion(own: dict[bytes, bytes]) -> np.ndarray:
    (kind,) = struct.unpack("<i", own[b"Jtt"])
    position = _number(own, b"Prt", b"_rt")
    if kind == 12:
        return _matrix(struct.unpack("<4d", own[b"_st"]) if b"_st" in own else struct.unpack("<4f", own[b"Jst"]))
    if kind == 11:
        return _matrix((1, 0, 0, 0), (0, 0, position))
    lead = _number(own, b"", b"Sld") / (2 * np.pi) or _number(own, b"Jsp", b"_sp")
    return _matrix((np.cos(position / 2), 0, 0, np.sin(position / 2)), (0, 0, lead * position))


def _mass(own: dict[bytes, bytes]) -> float:
    geometry = dict(_items(own[b"Ge2"]))
    body = dict(_items(geometry.get(b"Gst", geometry.get(b"Gsg", b""))))
    return _number(body, b"Mas", b"_as") or 0.001
