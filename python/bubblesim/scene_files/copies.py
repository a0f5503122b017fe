# SPDX-License-Identifier: BSD-3-Clause
"""A copy of a scene in another folder, with its child scripts: the user's own, to be edited."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

from bubblesim._core import scene_folders

_NAME = re.compile(r"[A-Za-z]\w*")
_CHILD_SCRIPT = re.compile(r"(<bubblesim:child_script>)\s*([^<]*?)\s*(</bubblesim:child_script>)")


def is_shipped(file: Path) -> bool:
    """Return whether a file is one of bubblesim's own scenes, models or scripts."""
    return file.resolve().is_relative_to(Path(scene_folders()[-1]).resolve())


def copy_scene(scene: Path, folder: Path, name: str, edited: Mapping[Path, str]) -> Path:
    """Write FOLDER/NAME.sdf, with the child scripts that the scene's file names in FOLDER/NAME/; return the new file.

    The text of the file stays, but for the paths of the scripts.

    :param edited: contents of scripts that were edited, by their resolved files, in place of what the files have.
    :raises ValueError: for a name that is not one of a scene, for two scripts of one name, and for the text of a script
        that the scene's file does not name.
    :raises FileExistsError: if the file or the folder exists; nothing is written then.
    """
    if not _NAME.fullmatch(name):
        raise ValueError(f"'{name}' is not a name of a scene: use a letter, then letters, digits and underscores")
    file = folder / f"{name}.sdf"
    for taken in (file, folder / name):
        if taken.exists():
            raise FileExistsError(f"{taken} exists already: choose another name")
    text = scene.read_text(encoding="utf-8")
    scripts = {(scene.parent / script).resolve() for _, script, _ in _CHILD_SCRIPT.findall(text)}
    if len({script.name for script in scripts}) < len(scripts):
        raise ValueError(f"{scene.name} cannot be copied: two of its child scripts have the same name")
    for script in edited.keys() - scripts:
        raise ValueError(f"{script.name} is the script of a model, which the copy would share: copy the model's folder")
    contents = {each.name: edited[each] if each in edited else each.read_text(encoding="utf-8") for each in scripts}
    if contents:
        (folder / name).mkdir()
    for script_name, content in contents.items():
        (folder / name / script_name).write_text(content, encoding="utf-8")
    file.write_text(_CHILD_SCRIPT.sub(lambda found: _moved(found, name), text), encoding="utf-8")
    return file


def _moved(child_script: re.Match[str], folder: str) -> str:
    begin, script, end = child_script.groups()
    return f"{begin}{folder}/{Path(script).name}{end}"
