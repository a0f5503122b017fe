# SPDX-License-Identifier: BSD-3-Clause
"""Opening files of CoppeliaSim, which a page has sent: first what is in them, then their scene, written as SDFormat.

Nothing of a file runs before the page has shown its scripts. Those in Python are left out unless the user wants them.
"""

from __future__ import annotations

import re
import shutil
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from bubblesim.running.foreign_scenes import read_foreign
from bubblesim.web import scene_files
from bubblesim.web.threads import in_thread

_KINDS = (".ttt", ".ttm")
_PATHS = re.compile(r"<(uri|script|albedo_map)>(meshes|scripts|textures)/")
_PYTHON = re.compile(r"\s*<script>[^<]*\.py</script>")


@dataclass
class ForeignFile:
    """The last file that a page has sent."""

    _folder: Path | None = None
    name: str = ""
    """Of the scene."""

    @property
    def scene(self) -> Path:
        """The folder of its conversion.

        :raises ValueError: if the page has sent none.
        """
        if self._folder is None:
            raise ValueError("no file of CoppeliaSim was sent by this page")
        return self._folder / "scene"

    def read(self, name: str, content: bytes) -> dict[str, Any]:
        """Convert a file; return its ``name`` as a scene, a ``description``, ``left_out`` and its ``scripts``, paths.

        :raises ValueError: for a file that is not one of CoppeliaSim, or is damaged.
        """
        if not name.endswith(_KINDS):
            raise ValueError(f"{name} is not a scene or model of CoppeliaSim ({' or '.join(_KINDS)})")
        self.close()
        self._folder = Path(tempfile.mkdtemp(prefix="bubblesim-opened-"))
        file = self._folder / f"file{Path(name).suffix}"  # its name is the page's
        file.write_bytes(content)
        self.scene.mkdir()
        try:
            description = read_foreign("describe", file)
            left_out = read_foreign("convert", file, self.scene)
        except ValueError as error:
            raise ValueError(str(error).replace(str(file), name)) from None
        self.name = re.sub(r"\W", "_", Path(name).stem) or "scene"
        scripts = sorted(str(each.relative_to(self.scene)) for each in (self.scene / "scripts").glob("*"))
        return {"name": self.name, "description": description, "left_out": left_out, "scripts": scripts}

    def write(self, folder: Path, *, python: bool) -> Path:
        """Write the scene to a new file in a folder, its meshes and scripts to a folder beside it; return the file.

        :param python: its scripts in Python are part of the scene; otherwise they are only kept beside it.
        """
        name, number = self.name, 1
        while any((folder / taken).exists() for taken in (name, f"{name}.sdf")):
            number += 1
            name = f"{self.name}_{number}"
        text = (self.scene / "scene.sdf").read_text(encoding="utf-8")
        if not python:
            text = _PYTHON.sub("", text)
        shutil.move(self.scene, folder / name)
        (folder / name / "scene.sdf").unlink()
        file = folder / f"{name}.sdf"
        file.write_text(_PATHS.sub(rf"<\1>{name}/\2/", text), encoding="utf-8")
        self.close()
        return file

    def close(self) -> None:
        """Delete what was not written."""
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)
            self._folder = None


async def read(page: Any, name: str, content: bytes) -> dict[str, Any]:
    """Return what is in a file of CoppeliaSim, see ForeignFile.read."""
    found: dict[str, Any] = await in_thread(page.foreign.read, name, content)
    return found


async def open_scene(page: Any, folder: str, python: bool) -> str:
    """Write the scene of the file that was read to a folder, and let the simulator load it; return the new file.

    :raises PermissionError: for a folder that is not one of ``server.sceneFolders``.
    """
    if folder not in await scene_files.folders(page):
        raise PermissionError(f"scenes cannot be written to {folder}")
    file: Path = await in_thread(lambda: page.foreign.write(Path(folder), python=python is True))
    await page.node.call("sim.loadScene", file.stem)
    return str(file)
