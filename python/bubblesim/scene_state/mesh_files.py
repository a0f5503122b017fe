# SPDX-License-Identifier: BSD-3-Clause
"""Reads mesh files that scripts import: Wavefront OBJ and STL."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

_MOST_BYTES = 256 << 20
_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])


def read_mesh(file: Path) -> tuple[Any, Any]:
    """Return vertices, n x 3, and triangles, m x 3 indices from 0; raise ValueError for a file that is no mesh."""
    readers = {".obj": _read_obj, ".stl": _read_stl}
    reader = readers.get(file.suffix.lower())
    if reader is None:
        raise ValueError(f"'{file}' is not the name of a mesh that scripts import: it ends in .obj or .stl")
    try:
        if file.stat().st_size > _MOST_BYTES:
            raise ValueError(f"{file} has more than {_MOST_BYTES >> 20} MiB")
        return reader(file, file.read_bytes())
    except OSError as error:
        raise ValueError(f"cannot read the mesh {file}: {error.strerror or error}") from None


def _read_stl(file: Path, data: bytes) -> tuple[Any, Any]:
    count = int.from_bytes(data[80:84], "little")
    if len(data) == 84 + count * _TRIANGLE.itemsize:
        corners = np.frombuffer(data, _TRIANGLE, count, 84)["corners"].reshape(-1, 3)
    else:
        lines = [line.split() for line in data.decode(errors="replace").splitlines()]
        corners = np.array(_numbers(file, [words[1:4] for words in lines if words[:1] == ["vertex"]]))
    if not len(corners) or len(corners) % 3:
        raise ValueError(f"{file}: an STL file has triangles, found {len(corners)} corners")
    vertices, indices = np.unique(corners.astype(float), axis=0, return_inverse=True)
    return vertices, indices.reshape(-1, 3)


def _read_obj(file: Path, data: bytes) -> tuple[Any, Any]:
    vertices: list[list[str]] = []
    triangles: list[list[int]] = []
    for number, line in enumerate(data.decode(errors="replace").splitlines(), start=1):
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append(words[1:4])
        elif words[:1] == ["f"]:
            try:
                corners = [int(word.partition("/")[0]) for word in words[1:]]
            except ValueError:
                raise ValueError(f"{file}:{number}: a face has numbers of vertices") from None
            found = [corner - 1 if corner > 0 else len(vertices) + corner for corner in corners]
            triangles += [[found[0], found[i], found[i + 1]] for i in range(1, len(found) - 1)]
    if not vertices or not triangles:
        raise ValueError(f"{file}: no faces of vertices are in it")
    return np.array(_numbers(file, vertices)), np.array(triangles)


def _numbers(file: Path, rows: list[list[str]]) -> list[list[float]]:
    try:
        numbers = [[float(word) for word in row] for row in rows]
    except ValueError as error:
        raise ValueError(f"{file}: {error}") from None
    if any(len(row) != 3 for row in numbers):
        raise ValueError(f"{file}: a vertex has three numbers")
    return numbers
