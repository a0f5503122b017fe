# SPDX-License-Identifier: BSD-3-Clause
"""Folders of models and media that ROS packages export to Gazebo in package.xml."""

from pathlib import Path

import pytest

import bubblesim

MANIFEST = """<package><name>{name}</name><export>
<gazebo_ros gazebo_model_path="${{prefix}}/models:${{prefix}}/more" gazebo_media_path="${{prefix}}"/>
</export></package>"""
SPHERE = "<geometry><sphere><radius>1</radius></sphere></geometry>"
LINK = f"<link name='l'><collision name='c'>{SPHERE}</collision></link>"
MODEL = f"<sdf version='1.6'><model name='crate'>{LINK}</model></sdf>"
MESH = """solid s
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 1 0
endloop
endfacet
endsolid s
"""


def package(folder: Path, name: str, models: str) -> Path:
    crate = folder / name / models / f"{name}_crate"
    crate.mkdir(parents=True)
    (folder / name / "package.xml").write_text(MANIFEST.format(name=name))
    (crate / "model.sdf").write_text(MODEL)
    (crate / "model.config").write_text("<model><name>c</name><sdf version='1.6'>model.sdf</sdf></model>")
    return folder / name


def includes(scene: Path, model: str) -> bool:
    scene.parent.mkdir()
    scene.write_text(f"<sdf version='1.6'><world name='w'><include><uri>model://{model}</uri></include></world></sdf>")
    return any(each.path == "/crate" for each in bubblesim.Simulation(str(scene)).objects)


@pytest.mark.parametrize("models", ["models", "more"])
def test_models_of_all_packages_are_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, models: str) -> None:
    package(tmp_path / "ws" / "group", "robots", models)
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "ws"))
    assert includes(tmp_path / "elsewhere" / "w.world", "robots_crate")


def test_those_of_the_package_around_the_scene_are_found_without_a_path(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    worlds = package(tmp_path, "worlds", "models") / "worlds"
    monkeypatch.setenv("ROS_PACKAGE_PATH", "/nowhere")
    assert includes(worlds / "w.world", "worlds_crate")


def test_media_are_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    meshes = package(tmp_path / "ws", "media", "models") / "meshes"
    meshes.mkdir()
    (meshes / "a.stl").write_text(MESH)
    scene = tmp_path / "m.sdf"
    scene.write_text(MODEL.replace(SPHERE, "<geometry><mesh><uri>file://meshes/a.stl</uri></mesh></geometry>"))
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "ws"))
    assert "mesh" in [shape.kind for shape in bubblesim.Simulation(str(scene)).collisions]
