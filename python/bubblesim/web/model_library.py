# SPDX-License-Identifier: BSD-3-Clause
"""The models that can be added to the scene, and what is needed to draw them before they are there."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import Any

from bubblesim._core import SceneView, Simulation, scene_folders
from bubblesim.web.threads import in_thread

_MOST = 500


async def models(page: Any) -> list[dict[str, str]]:
    """Return name and file of each model in the folders of models, as ``sim.loadModel`` searches them."""
    own = Path(page.hub.scene.get("file", "")).parent
    found: dict[str, str] = {}
    for folder in [own, *map(Path, scene_folders())]:
        for file in sorted((folder / "models").glob("*/model.sdf")):
            found.setdefault(file.parent.name, str(file))
    return [{"name": name, "file": file} for name, file in list(found.items())[:_MOST]]


async def preview(page: Any, name: str) -> list[dict[str, Any]]:
    """Return the objects of a model, as window.models does for those of the scene."""
    files = {each["name"]: each["file"] for each in await models(page)}
    objects: list[dict[str, Any]] = (await in_thread(_loaded, files[name]))[1]
    return objects


async def preview_mesh(page: Any, name: str, number: int) -> dict[str, Any]:
    """Return the arrays of a mesh of a model."""
    files = {each["name"]: each["file"] for each in await models(page)}
    mesh: dict[str, Any] = (await in_thread(_loaded, files[name]))[0].mesh(number)
    return mesh


async def preview_texture(page: Any, name: str, number: int) -> dict[str, Any]:
    """Return an image of a model."""
    files = {each["name"]: each["file"] for each in await models(page)}
    texture: dict[str, Any] = (await in_thread(_loaded, files[name]))[0].texture(number)
    return texture


@lru_cache(maxsize=64)
def _loaded(file: str) -> tuple[Any, list[dict[str, Any]]]:
    view = SceneView()
    simulation = Simulation(file)
    world = simulation.world
    # The last one is the model: a model file stands on a ground plane.
    objects = [view.model(simulation, model) for model in world.models]
    return view, objects[-1]
