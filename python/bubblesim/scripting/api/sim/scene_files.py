# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that load scenes and models."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from bubblesim._core import scene_folders
from bubblesim.scripting.api.functions import for_remote_only
from bubblesim.scripting.api.sim.created_objects import CreatedObjectFunctions


class SceneFileFunctions(CreatedObjectFunctions):
    """A node simulates one scene from its start to its end. Of a path only the name of the file counts: 'arm.ttm' is
    the model 'arm' of this project's folders."""

    @for_remote_only
    def loadScene(self, file: str) -> Any:
        """Stop the simulation, remove created objects and reset the scene, which must be that of the node; return 1.

        Another scene raises an error that says how to start it. For remote clients only.
        """
        raise RuntimeError(self._other_scene(file))

    @for_remote_only
    def closeScene(self) -> Any:
        """Stop the simulation, remove created objects and reset the scene; return 1. For remote clients only."""
        raise RuntimeError("sim.closeScene needs a running node")

    def loadModel(self, file: str) -> int:
        """Add a model by the name of its file and return its handle; not in sysCall_actuation and sysCall_sensing.

        It is searched as models/NAME/model.sdf and NAME.sdf in the folder of the scene and the folders of scenes. A
        name that is taken gets a number. It stays until it is removed.
        """
        found = next((path for path in self._places(file) if path.is_file()), None)
        if found is None:
            places = ", ".join(str(path) for path in self._places(file))
            raise LookupError(f"sim.loadModel: there is no model '{_stem(file)}'; searched: {places}")
        model = int(self._simulation.add_model(found.read_text(encoding="utf-8"), name=self._free_name(file)).handle)
        self._caller.shared.loaded_models.append(model)
        return model

    def _places(self, file: str) -> Iterator[Path]:
        name = _stem(file)
        own = Path(self._simulation.scene_file).parent
        for folder in dict.fromkeys([own, *map(Path, scene_folders())]):
            yield folder / "models" / name / "model.sdf"
            yield folder / f"{name}.sdf"

    def _free_name(self, file: str) -> str:
        taken = {self._tree.name(handle) for handle in self._tree.children(-1)}
        name = _stem(file)
        number = 1
        while (name if number == 1 else f"{name}_{number}") in taken:
            number += 1
        return name if number == 1 else f"{name}_{number}"

    def _other_scene(self, file: str) -> str:
        own = Path(self._simulation.scene_file)
        places = [Path(folder) / f"{_stem(file)}.sdf" for folder in [own.parent, *scene_folders()]]
        found = next((path for path in places if path.is_file()), None)
        if found is None:
            searched = ", ".join(str(path) for path in dict.fromkeys(places))
            return f"sim.loadScene: there is no scene '{_stem(file)}'; searched: {searched}"
        return (
            f"sim.loadScene: this node simulates the scene {own.stem}, and loads no other one; start another node with "
            f"`rosrun bubblesim sim {found.stem} --remote`"
        )


def _stem(file: str) -> str:
    """Return the name of a file, which may be a path of another system, without folder and extension."""
    name = Path(file.replace("\\", "/")).stem
    if not name or name in (".", ".."):
        raise ValueError(f"'{file}' does not name a file")
    return name
