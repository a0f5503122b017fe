# SPDX-License-Identifier: BSD-3-Clause
"""Writes small files of CoppeliaSim for tests."""

import struct
from pathlib import Path

IDENTITY = (1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


def item(tag: str, content: bytes) -> bytes:
    return tag.encode() + struct.pack("<i", len(content)) + content


def text(value: str) -> bytes:
    return struct.pack("<i", len(value)) + value.encode()


def thing(tag: str, handle: int, parent: int, alias: str, own: bytes, pose: tuple[float, ...] = IDENTITY) -> bytes:
    """Return an object; the pose is w x y z and then x y z."""
    common = item("Ids", struct.pack("<2i", handle, parent)) + item("_fq", struct.pack("<7d", *pose))
    return item(tag, common + item("Ali", text(alias)) + b"NXT" + own + b"EOO")


def cuboid(size: tuple[float, float, float], mass: float | None = None) -> bytes:
    """Return the second half of a cuboid, static without a mass; its inertia is that of a homogeneous one."""
    x, y, z = size
    moments = ((y * y + z * z) / 12, (x * x + z * z) / 12, (x * x + y * y) / 12)
    matrix = (moments[0], 0, 0, 0, moments[1], 0, 0, 0, moments[2])
    body = item("_as", struct.pack("<d", mass or 0)) + item("Com", bytes(24)) + item("Imx", struct.pack("<9d", *matrix))
    mesh = item("_pr", struct.pack("<i3d", 3, *size))
    shape = item("Ge2", item("Gst", body + b"EOO" + mesh + b"EOO") + b"EOO")
    return shape + item("Sss", bytes([0x80 if mass else 0])) + item("Ss3", b"\1") + item("Dc2", b"\xff\xff")


def joint(position: float, control: int, target: float) -> bytes:
    """Return the second half of a revolute joint in dynamic mode, from -2 to 2 rad."""
    return (
        item("Jtt", struct.pack("<i", 10))
        + item("_rt", struct.pack("<d", position))
        + item("_mr", struct.pack("<2d", -2, 4))
        + item("Jmd", struct.pack("<i", 5))
        + item("Dcm", struct.pack("<i", control))
        + item("_mp", struct.pack("<2d", target, 100))
        + item("_tp", struct.pack("<d", target))
    )


def obscured(script: str) -> bytes:
    """Return the text as the format has it: the inverse of the rule by which it is read."""
    data = bytearray(script.encode())
    signed = [value - 256 if value > 127 else value for value in (data[0], data[-1])]
    s, e = int(signed[0] / 2), 3 * signed[1]
    for i in range(1, len(data) - 1):
        change = (i + s + e if i & 1 else 0) - (3 * i + s if i & 2 else 0) + (i // 2 + e if i & 4 else 0)
        data[i] = (data[i] - change) % 256
    return bytes(data)


def _script_list(owner: int, content: str, language: str, kind: int) -> bytes:
    fields = item("Si2", struct.pack("<3i", 900 + owner + kind, owner, kind)) + item("Ste", obscured(content))
    return fields + item("Va2", b"\x08") + item("Lne", text(language)) + b"EOO"


def script(owner: int, content: str, language: str = "lua", kind: int = 1) -> bytes:
    return item("LST", _script_list(owner, content, language, kind))


def script_object(handle: int, owner: int, content: str, language: str = "lua") -> bytes:
    """Return a script as files of V4.7 and later have it: an object below the one for which it acts."""
    return thing("SCT", handle, owner, "Script", item("Soo", _script_list(handle, content, language, 1)))


def write(file: Path, *parts: bytes, is_scene: bool = True) -> Path:
    """Write a scene, or a model, that is not packed."""
    content = b"".join(parts) + (item("ENV", b"EOO") if is_scene else b"") + b"EOF"
    header = b"VREP" + struct.pack("<iiBiiH", 25, 24, 0, len(content), 0, 41000)
    file.write_bytes(header.ljust(1021, b"\0") + content)
    return file


FLOOR = thing("SHP", 1, -1, "Floor", cuboid((5, 5, 0.1)), (1, 0, 0, 0, 0, 0, -0.05))
BOX = thing("SHP", 2, -1, "Box", cuboid((0.2, 0.2, 0.2), 2), (1, 0, 0, 0, 0, 0, 0.5))
LUA = "sim=require'sim'\nfunction sysCall_init()\n  print('it is '..sim.getObjectAlias(sim.getObject('.')))\nend\n"
PYTHON = "def sysCall_init():\n    print('python runs')\n"


def arm(position: float, control: int, target: float, more: bytes = b"") -> bytes:
    """Return a static base and an arm of 1 m that turns about the vertical; `more` is of its joint."""
    return (
        thing("SHP", 10, -1, "Base", cuboid((0.1, 0.1, 0.1)))
        + thing("JNT", 11, 10, "motor", joint(position, control, target) + more)
        + thing("SHP", 12, 11, "Arm", cuboid((1, 0.05, 0.05), 1), (1, 0, 0, 0, 0.5, 0, 0))
    )


def mesh(first: int, mass: float | None = None) -> bytes:
    """Return the second half of a shape with the vertices and triangles of a number in `arrays`."""
    numbers = item("Vev", struct.pack("<i", first)) + item("Inv", struct.pack("<i", first))
    body = item("_as", struct.pack("<d", mass or 0)) + b"EOO"
    shape = item("Ge2", item("Gst", body + numbers + b"EOO") + b"EOO")
    return shape + item("Sss", bytes([0x80 if mass else 0])) + item("Ss3", b"\0") + item("Dc2", b"\xff\xff")


def arrays(*meshes: tuple[list[tuple[float, float, float]], list[tuple[int, int, int]]]) -> bytes:
    """Return the vertices and triangles of meshes; they come before the objects."""
    vertices = [item("Ver", struct.pack(f"<{3 * len(v)}f", *(x for each in v for x in each))) for v, _ in meshes]
    triangles = [item("Ind", struct.pack(f"<{3 * len(t)}i", *(i for each in t for i in each))) for _, t in meshes]
    return item("VIN", b"".join(vertices + triangles) + b"EOO")
