# SPDX-License-Identifier: BSD-3-Clause
"""Copies of scenes with their child scripts."""

from pathlib import Path

import pytest

from bubblesim import Scene, Simulation, scene_folders
from bubblesim.scene_files.copies import copy_scene, is_shipped
from node_support import write

SHIPPED = Path(scene_folders()[-1])


def test_what_comes_with_the_simulator_is_shipped(tmp_path: Path) -> None:
    assert is_shipped(SHIPPED / "tricycle.py")
    assert is_shipped(SHIPPED / "models" / "Bill" / "walk.py")
    assert not is_shipped(write(tmp_path / "tricycle.py", ""))


def test_a_copy_has_the_text_of_the_scene_and_its_scripts_beside_it(tmp_path: Path) -> None:
    file = copy_scene(SHIPPED / "bubblerobs.sdf", tmp_path, "mine", {})
    assert file == tmp_path / "mine.sdf"
    script = "<bubblesim:child_script>{}bubblerob.py<"
    assert file.read_text() == (SHIPPED / "bubblerobs.sdf").read_text().replace(
        script.format(""), script.format("mine/")
    )
    assert (tmp_path / "mine" / "bubblerob.py").read_text() == (SHIPPED / "bubblerob.py").read_text()
    copied, original = (Simulation(Scene(str(each))) for each in (file, SHIPPED / "bubblerobs.sdf"))
    assert copied.state_hash() == original.state_hash()


@pytest.mark.parametrize("text", ["print('edited')\n", ""])
def test_an_edited_script_is_written_as_it_was_edited(tmp_path: Path, text: str) -> None:
    copy_scene(SHIPPED / "tricycle.sdf", tmp_path, "mine", {(SHIPPED / "tricycle.py").resolve(): text})
    assert (tmp_path / "mine" / "tricycle.py").read_text() == text


def test_scripts_elsewhere_come_along(tmp_path: Path) -> None:
    scene = (SHIPPED / "tricycle.sdf").read_text().replace(">tricycle.py<", f">{SHIPPED / 'tricycle.py'}<")
    copy_scene(write(tmp_path / "saved.sdf", scene), tmp_path, "mine", {})
    assert ">mine/tricycle.py<" in (tmp_path / "mine.sdf").read_text()
    assert (tmp_path / "mine" / "tricycle.py").exists()


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("my scene", "'my scene' is not a name of a scene"),
        ("../mine", "is not a name of a scene"),
        ("taken", r"taken\.sdf exists already: choose another name"),
        ("folder", r"folder exists already: choose another name"),
    ],
)
def test_what_cannot_be_copied_is_refused_and_nothing_is_written(tmp_path: Path, name: str, message: str) -> None:
    write(tmp_path / "taken.sdf", "")
    (tmp_path / "folder").mkdir()
    before = set(tmp_path.rglob("*"))
    with pytest.raises((ValueError, FileExistsError), match=message):
        copy_scene(SHIPPED / "tricycle.sdf", tmp_path, name, {})
    assert set(tmp_path.rglob("*")) == before


def test_the_script_of_a_model_is_not_copied(tmp_path: Path) -> None:
    edited = {(SHIPPED / "models" / "Bill" / "walk.py").resolve(): ""}
    with pytest.raises(ValueError, match=r"walk\.py is the script of a model"):
        copy_scene(SHIPPED / "tricycle.sdf", tmp_path, "mine", edited)
    assert list(tmp_path.iterdir()) == []


def test_scripts_of_the_same_name_are_refused(tmp_path: Path) -> None:
    (tmp_path / "other").mkdir()
    write(tmp_path / "other" / "bubblerob.py", "")
    text = (SHIPPED / "bubblerobs.sdf").read_text().replace(">bubblerob.py<", ">other/bubblerob.py<", 1)
    write(tmp_path / "bubblerob.py", "")
    with pytest.raises(ValueError, match="two of its child scripts have the same name"):
        copy_scene(write(tmp_path / "three.sdf", text), tmp_path, "mine", {})
