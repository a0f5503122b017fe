# SPDX-License-Identifier: BSD-3-Clause
"""Public files of CoppeliaSim, if there are any beside the project: poses, masses, and how they stand."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import bubblesim
from ttt_reader import FileObject, roots
from ros_support import REPOSITORY


def public_files() -> list[Path]:
    folders = [folder / "shared" / "ttt" for folder in (REPOSITORY.parent, REPOSITORY.parent.parent)]
    files = [file for folder in folders for suffix in ("ttt", "ttm") for file in folder.rglob(f"*.{suffix}")]
    return sorted(file for file in set(files) if file.stat().st_size > 0)


FILES = public_files()
SMALL = 310_000
"""Bytes of files that the reader of the tests unpacks in a second."""

pytestmark = pytest.mark.skipif(not FILES, reason="no public files of CoppeliaSim are beside the project")


def named(file: Path) -> str:
    return f"{file.parent.name}/{file.name}"


@pytest.fixture(autouse=True)
def _own_cache(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> None:
    """Keep conversions out of the user's cache."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))


def matrix(pose: list[float]) -> np.ndarray:
    """Return the transformation of x y z and a quaternion x y z w."""
    x, y, z, w = pose[3:]
    made = np.eye(4)
    made[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    made[:3, 3] = pose[:3]
    return made


@pytest.mark.parametrize("file", [file for file in FILES if file.stat().st_size < SMALL], ids=named)
def test_objects_are_where_the_file_has_them(file: Path) -> None:
    simulation = bubblesim.Simulation(str(file))
    world = simulation.world
    frames = bubblesim._core.ObjectFrames(world)
    mass = 0.0

    def compare(described: list[FileObject], above: np.ndarray, handles: list[int]) -> None:
        nonlocal mass
        # A model gets a floor, which is no object of the file.
        handles = [handle for handle in handles if world.alias(handle) != "ground_plane"]
        assert len(handles) == len(described)
        for each, handle in zip(described, handles, strict=True):
            here = above @ each.frame
            assert np.abs(matrix(frames.pose(handle)) - here).max() < 1e-6, world.path(handle)
            mass += each.mass or 0
            compare(each.children, here @ each.motion, world.children(handle))

    compare(roots(file), np.eye(4), world.children(-1))
    moving = [model for model in world.models if not world.is_static(model)]
    held = sum(1 for model in moving if any(world.name(link).endswith("_held") for link in world.parts(model, "joint")))
    assert sum(world.mass(model) for model in moving) == pytest.approx(mass, abs=1e-6 + 1.001 * held)
