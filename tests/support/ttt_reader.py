# SPDX-License-Identifier: BSD-3-Clause
"""A second reader of CoppeliaSim's files, for tests: the tree, poses, masses and vertices, straight from the bytes."""

from __future__ import annotations

import functools
import struct
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

_MARKERS = (b"EOO", b"NXT", b"EOF")
_KINDS = b"SHP JNT DMY SNR RSN FSE CMA LGT SCT GRH PAT MIL MIR OCT PTC MKR CSO".split()
_HEADER = 1021
_AT_ONCE = 1 << 16
"""Bytes that are decoded together."""


@dataclass
class FilePart:
    """A mesh of a shape."""

    primitive: int
    """0 none, 1 plane, 2 disc, 3 cuboid, 4 spheroid, 5 cylinder, 6 cone, 7 heightfield, 8 capsule."""
    points: np.ndarray
    """n x 3, in the frame of the shape."""
    up: np.ndarray
    """Its z axis, in the frame of the shape."""
    is_wireframe: bool


@dataclass
class FileShape:
    is_static: bool
    is_respondable: bool
    """With shapes of its own tree, or with others."""
    parts: list[FilePart]


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
    is_visible: bool = True
    """By its layers."""
    flags: int = 0
    """What it forbids all below it, if it is a model."""
    shape: FileShape | None = None
    children: list[FileObject] = field(default_factory=list)


@functools.lru_cache(maxsize=2)
def unpacked(file: Path) -> bytes:
    return _content(file.read_bytes())


@functools.lru_cache(maxsize=1)
def roots(file: Path) -> list[FileObject]:
    """Return the objects at the top, with those below them in their order."""
    objects = {each.handle: each for each in _objects(unpacked(file))}
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
    # In preorder, codes are in the order of their bits: a window of bits belongs to the last code that is not above it.
    width = 56
    starts = np.array([int(code or "0", 2) << (width - len(code)) for code in codes], np.int64)
    order = np.argsort(starts)
    values = np.array(list(codes.values()), np.uint8)[order]
    widths = np.array([len(code) or 1 for code in codes], np.uint8)[order]
    leaves = [_leaves(data, first, starts[order]) for first in range(0, len(data), _AT_ONCE)]
    leaf = np.concatenate(leaves)
    steps = widths[leaf].tobytes()
    places = np.empty(size, np.int64)
    for i in range(size):
        places[i] = place
        place += steps[place]
    return values[leaf[places]].tobytes()


def _leaves(data: bytes, first: int, starts: np.ndarray) -> np.ndarray:
    """Return which code would begin at each bit of some bytes."""
    part = np.frombuffer(data[first : first + _AT_ONCE + 8] + bytes(8), np.uint8)
    count = min(_AT_ONCE, len(data) - first)
    window = np.zeros(count, np.uint64)
    for i in range(8):
        window = window << np.uint64(8) | part[i : i + count].astype(np.uint64)
    at_bits = window[:, None] << np.arange(8, dtype=np.uint64) >> np.uint64(8)  # 56 bits
    found = np.searchsorted(starts, at_bits.reshape(-1).astype(np.int64), "right") - 1
    return found.astype(np.uint8)


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
    lists = list(_items(content))
    arrays = [data for tag, all_data in lists if tag == b"VIN" for tag, data in _items(all_data) if tag == b"Ver"]
    layers = _active_layers(dict(lists))
    has_bodies = dict(_items(dict(lists).get(b"DYN", b""))).get(b"Var", b"\1")[0] & 1
    for tag, data in lists:
        if tag not in _KINDS:
            continue
        common = dict(_items(data))
        own = dict(_items(common[b"NXT"]))
        handle, parent = struct.unpack_from("<2i", common[b"Ids"])
        numbers = struct.unpack("<7d", common[b"_fq"]) if b"_fq" in common else struct.unpack("<7f", common[b"Cfq"])
        name = common.get(b"Ali", common.get(b"Nme", b"\0\0\0\0"))[4:].decode(errors="replace").split("#")[0]
        order = struct.unpack("<i", common[b"Cor"])[0] if b"Cor" in common else -1
        kind = tag.decode()
        made = FileObject(kind, handle, parent, name, order, _matrix(numbers[:4], numbers[4:]), np.eye(4), None)
        if kind == "JNT":
            made.motion = _motion(own)
        is_model = next((common[item][0] & 1 for item in (b"Va3", b"Va2", b"Var") if item in common), 0)
        flags = struct.unpack("<i", common[b"Mpo"])[0] if b"Mpo" in common else 0
        made.flags = flags if is_model and flags & 0xF000 != 0xF000 else 0
        made.is_visible = bool(struct.unpack("<H", common[b"Lar"])[0] & layers)
        if kind == "SHP":
            made.shape = _shape(own, arrays)
            made.mass = _mass(own) if has_bodies and not made.shape.is_static and not flags & 0x20 else None
        yield made


def _active_layers(lists: dict[bytes, bytes]) -> int:
    for tag, item in ((b"ENV", b"Vil"), (b"SET", b"Al2")):
        found = dict(_items(lists.get(tag, b""))).get(item)
        if found is not None:
            return int(struct.unpack("<H", found)[0])
    return 0xFF


def _shape(own: dict[bytes, bytes], arrays: list[bytes]) -> FileShape:
    geometry = dict(_items(own.get(b"Ge2", b"")))
    meshes = [geometry[b"Gst"]] if b"Gst" in geometry else []
    compounds = [geometry[b"Gsg"]] if b"Gsg" in geometry else []
    while compounds:
        for tag, data in _items(compounds.pop()):
            if tag == b"Geo":
                meshes.append(data)
            elif tag == b"Wrp":
                compounds.append(data)
    mask = struct.unpack("<H", own[b"Dc2"])[0] if b"Dc2" in own else 0xFFFF
    collides = bool(own.get(b"Ss3", own.get(b"Ss2", b"\0"))[0] & 1) and mask != 0
    return FileShape(not own[b"Sss"][0] & 0x80, collides, [_part(mesh, arrays) for mesh in meshes])


def _part(mesh: bytes, arrays: list[bytes]) -> FilePart:
    own = dict(_items(dict(_items(mesh))[b"EOO"]))
    vertices = own[b"Ver"] if b"Ver" in own else arrays[struct.unpack("<i", own[b"Vev"])[0]]
    points = np.frombuffer(vertices, "<f4").astype(float).reshape(-1, 3)
    numbers = struct.unpack("<7d", own[b"_pf"]) if b"_pf" in own else struct.unpack("<7f", own[b"Ppf"])
    frame = _matrix(numbers[3:], numbers[:3])
    primitive = struct.unpack_from("<i", own.get(b"_pr", own.get(b"Ppr", bytes(4))))[0]
    is_wireframe = bool(own.get(b"Var", b"\0")[0] & 4)
    return FilePart(primitive, points @ frame[:3, :3].T + frame[:3, 3], frame[:3, 2], is_wireframe)


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
