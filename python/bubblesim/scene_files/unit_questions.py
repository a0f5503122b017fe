# SPDX-License-Identifier: BSD-3-Clause
"""Values of a scene that are legal, and probably in another unit than their author meant."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from xml.parsers import expat

import bubblesim

_FORMATS = {".sdf", ".urdf", ".world", ".xml"}
_MOST_RADIANS = 2.0 * math.pi + 0.01
_LARGE = 20.0  # m
_LONG = 0.05  # s; in such a substep, what falls reaches 0.5 m/s
_THIN = 1e-5  # kg/m^3, mass over the cube of the length; a rope of 30 m and 1 kg has 4e-5, a robot in millimetres 1e-7


def report_unit_questions(simulation: bubblesim.Simulation) -> int:
    """Write a warning for each questionable value to stderr; return how many."""
    count = 0
    for question in [*_angles(Path(simulation.scene_file)), *_sizes(simulation), *_steps(simulation)]:
        print(f"warning: {question}", file=sys.stderr)
        count += 1
    return count


def _angles(file: Path) -> Iterator[str]:
    """Yield the rotations of a file by more than a turn: degrees are taken for radians easily."""
    if file.suffix not in _FORMATS or not file.is_file():
        return
    for line, where, numbers in _rotations(file):
        for axis, number in zip(("roll", "pitch", "yaw"), numbers, strict=False):
            if abs(number) > _MOST_RADIANS:
                degrees = f"{number:g} degrees are {math.radians(number):.4f}"
                yield f"{file}:{line}: {where} has a {axis} of {number:g} rad, more than a turn; {degrees}"


def _rotations(file: Path) -> list[tuple[int, str, list[float]]]:
    """Return line, element and angles of all rotations in radians."""
    found: list[tuple[int, str, list[float]]] = []
    text: list[str] = []
    parser = expat.ParserCreate()
    in_radians: list[bool] = []

    def start(name: str, attributes: dict[str, str]) -> None:
        text.clear()
        quaternion = attributes.get("rotation_format", "euler_rpy") != "euler_rpy"
        in_radians.append(name == "pose" and attributes.get("degrees") not in ("true", "1") and not quaternion)
        if "rpy" in attributes:
            found.append((parser.CurrentLineNumber, f"rpy of <{name}>", _numbers(attributes["rpy"])))

    def end(name: str) -> None:
        if in_radians.pop():
            found.append((parser.CurrentLineNumber, f"<{name}>", _numbers("".join(text))[3:6]))

    parser.StartElementHandler = start
    parser.EndElementHandler = end
    parser.CharacterDataHandler = text.append
    try:
        parser.Parse(file.read_bytes(), True)
    except expat.ExpatError:
        return []  # the reader of scenes accepts more, and reports what it does not
    return found


def _numbers(text: str) -> list[float]:
    try:
        return [float(word) for word in text.split()]
    except ValueError:
        return []


def _sizes(simulation: bubblesim.Simulation) -> Iterator[str]:
    """Yield the models that are large and almost without mass: millimetres are taken for metres easily."""
    spheres: dict[str, list[tuple[Any, float]]] = {}
    for shape in simulation.collisions:
        if not shape.is_static and shape.kind != "plane":
            model = "/" + shape.object_path.strip("/").split("/")[0]
            spheres.setdefault(model, []).append((shape.position, _reach(shape)))
    for model, found in spheres.items():
        length = max(
            max(place[axis] + reach for place, reach in found) - min(place[axis] - reach for place, reach in found)
            for axis in range(3)
        )
        mass = simulation.object(model).mass
        if length > _LARGE and mass < _THIN * length**3:
            yield (
                f"{model}: it is about {length:.3g} m large and has a mass of {mass:.3g} kg; lengths are in metres, "
                f'a mesh in millimetres needs <scale>0.001 0.001 0.001</scale> (URDF: scale="0.001 0.001 0.001")'
            )


def _steps(simulation: bubblesim.Simulation) -> Iterator[str]:
    """Yield the physics substep if it is long: milliseconds are taken for seconds easily."""
    substep = simulation.substep
    if substep > _LONG:
        yield (
            f"{simulation.scene_file}: the physics substep is {substep:g} s, in which bodies pass through each other; "
            "<max_step_size> is in seconds, usual values are 0.001 to 0.01"
        )


def _reach(shape: Any) -> float:
    """Return the radius of a sphere about the shape's place that contains it, m."""
    if shape.kind == "mesh":
        return max((math.hypot(*map(float, vertex)) for vertex in shape.vertices), default=0.0)
    return float(max(shape.size)) * (1.0 if shape.kind in ("sphere", "ellipsoid") else 0.5)
