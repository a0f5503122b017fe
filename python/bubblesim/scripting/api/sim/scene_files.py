# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that load scenes and models."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from bubblesim._core import SceneError, scene_folders
from bubblesim.scene_state.saved_scene import scene_text, write_scene
from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.functions import for_remote_only
from bubblesim.scripting.api.sim.browser_models import browser_model, suggestion
from bubblesim.scripting.api.sim.created_sensors import CreatedSensorFunctions

_SCENES = (".sdf", ".world", ".urdf")
_FOREIGN = (".ttt", ".ttm")


class SceneFileFunctions(CreatedSensorFunctions):
    """Of a path only the name of the file counts: 'robots/arm.ttm' is the model 'arm' of the folders that are searched.
    A Python script, and a client of a node with --remote-trusted, can also give the path of an .sdf, .ttt or .ttm file;
    an .sdf file of the same name beside it comes first."""

    @differs(
        "it loads any file, also for scripts; here the scene of that name in the folders of scenes, for remote clients"
    )
    @for_remote_only
    def loadScene(self, file: str) -> Any:
        """Stop the simulation and load another scene; return 1. An empty name loads the empty scene.

        It is searched as NAME.sdf, then as NAME.ttt, in the folder of the first scene, the folder in which the node was
        started, and the folders of scenes, also with the folder that the path gives, such as messaging/NAME.sdf. All
        handles become invalid. If the file has errors, the present scene stays. For remote clients only.
        """
        raise RuntimeError("sim.loadScene needs a running node")

    @differs("scripts may call it; here remote clients alone")
    @for_remote_only
    def closeScene(self) -> Any:
        """Stop the simulation and go on with an empty scene, a ground plane; return 1. For remote clients only."""
        raise RuntimeError("sim.closeScene needs a running node")

    @differs("it writes a .ttt file; here one in SDFormat")
    @for_remote_only
    def saveScene(self, file: str, overwrite: bool = False) -> int:
        """Write the scene of a stopped simulation to an .sdf file, which takes the place of a .ttt file; return 1.

        The file has the current models and their poses. An existing file is an error unless ``overwrite`` is true, and
        so are names, parents and static flags that were changed; dummies, and colours of models of an <include>, are
        not written. For clients of a node with --remote-trusted only.
        """
        if not self._caller.may_use_files:
            raise PermissionError("sim.saveScene writes files: start the node with --remote-trusted")
        if not self._is_stopped():
            raise RuntimeError("sim.saveScene: stop the simulation first")
        wanted = Path(file)
        file_path = wanted if wanted.suffix == ".world" else wanted.with_suffix(".sdf")
        write_scene(scene_text(self._simulation, self._edits, file_path.parent), file_path, overwrite=overwrite)
        return 1

    def loadModel(self, file: str) -> int:
        """Add a model by the name of its file and return its handle; not in sysCall_sensing.

        It is searched as models/NAME/model.sdf and NAME.sdf, then as NAME.ttm and models/NAME.ttm, in the folder of the
        scene and the folders of scenes. A .ttm file that is not there is one of CoppeliaSim's model browser, such as
        'pioneer p3dx.ttm': ours of the same kind. A name that is taken gets a number; aliases of a .ttm file stay. It
        stays until it is removed. The scripts of a .ttm file run as those of a .ttt file do.
        """
        name = stem(file)
        own = Path(scene_folders()[-1])
        folders = [self._own_folder(), *map(Path, scene_folders())]
        of_browser = browser_model(file)
        if of_browser and file.casefold().endswith(".ttm"):
            folders = [folder for folder in folders if folder.absolute() != own.absolute()]
        kinds = (f"models/{name}/model.sdf", f"{name}.sdf"), (f"{name}.ttm", f"models/{name}.ttm")
        places = [folder / place for kind in kinds for folder in folders for place in kind]
        if of_browser and self._existing(file, places) is None:
            return self._tree.object_of(self._add_model(of_browser.text(), of_browser.object))
        found = self._find("sim.loadModel", "model", file, places, suggestion(name))
        if found.suffix in _FOREIGN:
            return self._add_foreign_models(found)
        try:
            return self._add_model(found.read_text(encoding="utf-8"), name)
        except SceneError as error:
            raise SceneError(str(error).replace("<data-string>", str(found))) from None

    def _own_folder(self) -> Path:
        return Path(self._simulation.scene_file).parent

    def _find(self, function: str, what: str, file: str, places: Sequence[Path], hint: str = "") -> Path:
        """Return the first of these files that exists, or the given one if the caller may use all files.

        :raises LookupError: with the files that were searched, and the hint.
        """
        found = self._existing(file, places)
        if found is None:
            searched = ", ".join(map(str, self._searched(file, places)))
            raise LookupError(f"{function}: there is no {what} '{stem(file)}'; searched: {searched}{hint}")
        return found

    def _existing(self, file: str, places: Sequence[Path]) -> Path | None:
        return next((place for place in self._searched(file, places) if place.is_file()), None)

    def _searched(self, file: str, places: Sequence[Path]) -> list[Path]:
        """Return these places, after the given one if the caller may use all files."""
        searched = list(dict.fromkeys(place.absolute() for place in places))
        if self._caller.may_use_files and Path(file).parent != Path():
            given = Path(file)
            searched.insert(0, given if given.suffix in _SCENES else given.with_suffix(".sdf"))
            if given.suffix in _FOREIGN:
                searched.insert(1, given)
        return searched


def stem_with_folder(file: str) -> str:
    """Return the stem after the name of its folder, such as 'messaging/images', or the stem alone."""
    folder = Path(file.replace("\\", "/")).parent.name
    return stem(file) if folder in ("", "..") else f"{folder}/{stem(file)}"


def stem(file: str) -> str:
    """Return the name of a file, which may be a path of another system, without folder and extension."""
    name = Path(file.replace("\\", "/")).stem
    if not name or name in (".", ".."):
        raise ValueError(f"'{file}' does not name a file")
    return name
