# SPDX-License-Identifier: BSD-3-Clause
"""Saving the scene to a new file: in the folder where the window was started, or in that of the scene."""

from __future__ import annotations

import os
from functools import partial
from pathlib import Path
from typing import Any

from bubblesim.scene_state.saved_scene import write_scene
from bubblesim.web.threads import in_thread

_SUFFIXES = (".sdf", ".world")


async def folders(page: Any) -> list[str]:
    """Return the folders in which a scene can be saved."""
    scene = Path(page.hub.scene.get("file", ""))
    found = [Path.cwd(), *([scene.absolute().parent] if scene.name else [])]
    return [str(folder) for folder in dict.fromkeys(found) if os.access(folder, os.W_OK)]


async def save(page: Any, folder: str, name: str, overwrite: bool) -> dict[str, Any]:
    """Write the scene to a file in one of ``folders``.

    :param name: of the file, without a folder; .sdf is added if it ends neither so nor in .world.
    :return: the ``file``, and whether it is ``saved``: a file that exists is left alone unless ``overwrite`` is true.
    """
    usable = await folders(page)
    if folder not in usable:
        raise PermissionError(f"scenes cannot be saved in {folder}; they can in {', '.join(usable)}")
    if not name or name.startswith(".") or Path(name).name != name:
        raise ValueError(f"'{name}' is not the name of a file: give a name without a folder")
    file = Path(folder, name if name.endswith(_SUFFIXES) else f"{name}.sdf")
    text = await page.node.call("window.get_scene_text", folder)
    try:
        await in_thread(partial(write_scene, text, file, overwrite=overwrite is True))
    except FileExistsError:
        return {"file": str(file), "saved": False}
    return {"file": str(file), "saved": True}
