# SPDX-License-Identifier: BSD-3-Clause
"""Copies of shipped scenes, with what the page's editor has changed in their scripts."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from bubblesim.scene_files.copies import copy_scene, is_shipped
from bubblesim.web import scene_files
from bubblesim.web.threads import in_thread


async def folders(page: Any) -> list[str]:
    """Return the folders in which the user's copy of a scene can be."""
    return [folder for folder in await scene_files.folders(page) if not is_shipped(Path(folder))]


async def open_copy(page: Any, folder: str, name: str, edited: list[list[Any]]) -> str:
    """Write a copy of the scene to a folder, and let the simulator load it; return the new file.

    :param edited: handle of the object and text, of each script that was edited.
    :raises PermissionError: for a folder that is not one of ``server.copyFolders``.
    :raises ValueError: see copy_scene.
    :raises FileExistsError: see copy_scene.
    """
    usable = await folders(page)
    if folder not in usable:
        raise PermissionError(f"no copy can be written to {folder}; it can to {', '.join(usable) or 'no folder'}")
    by_handle = {int(handle): str(text) for handle, text in edited}
    scripts = await page.node.call("sim.getScripts")
    by_file = {
        Path(each["file"]).resolve(): by_handle[each["handle"]] for each in scripts if each["handle"] in by_handle
    }
    scene = Path(page.hub.scene["file"])
    file: Path = await in_thread(copy_scene, scene, Path(folder), name, by_file)
    await page.node.call("sim.loadScene", file.stem)
    return str(file)
