# SPDX-License-Identifier: BSD-3-Clause
"""Worlds that include models of CoppeliaSim."""

from pathlib import Path

import pytest

import bubblesim
from node_support import run_sim
from ttt_files import BOX, LUA, PYTHON, arm, script, thing, write


def world(tmp_path: Path, *includes: str, inside: str = "") -> Path:
    """Write a world with a floor, includes and further elements."""
    included = "".join(f"<include>{each}</include>" for each in includes)
    file = tmp_path / "scene.sdf"
    floor = "<include><uri>model://ground_plane</uri></include>"
    file.write_text(f'<sdf version="1.9"><world name="w">{floor}{included}{inside}</world></sdf>')
    return file


ARM = "<uri>file://arm.ttm</uri>"


def test_an_included_model_is_where_its_file_and_the_pose_put_it(tmp_path: Path) -> None:
    write(tmp_path / "arm.ttm", arm(0, 0, 0), is_scene=False)
    simulation = bubblesim.Simulation(str(world(tmp_path, f"{ARM}<pose>1 2 3 0 0 1.5707963267948966</pose>")))
    assert simulation.object("/Base").position == pytest.approx((1, 2, 3), abs=1e-9)
    assert simulation.object("/Base/motor/Arm").position == pytest.approx((1, 2.5, 3), abs=1e-9)


def test_two_of_one_file_have_their_names_poses_and_motors(tmp_path: Path) -> None:
    tip = thing("DMY", 20, 12, "tip", b"", (1, 0, 0, 0, 0.5, 0, 0))
    write(tmp_path / "arm.ttm", arm(0.5, 8, -0.25), tip, is_scene=False)
    left, right = (f"{ARM}<name>{name}</name><pose>0 {y} 1 0 0 0</pose>" for name, y in (("left", 2), ("right", -2)))
    simulation = bubblesim.Simulation(str(world(tmp_path, left, right)))
    assert simulation.object("/left").position == pytest.approx((0, 2, 1), abs=1e-9)
    assert simulation.object("/right/motor").joint_position == pytest.approx(0.5, abs=1e-9)
    simulation.step(60)
    for name, y in (("left", 2), ("right", -2)):
        assert simulation.object(f"/{name}/motor").joint_position == pytest.approx(-0.25, abs=1e-3)
        assert simulation.object(f"/{name}/motor/Arm/tip").position[1] == pytest.approx(y - 0.2474, abs=1e-3)


def test_a_reset_brings_an_included_model_back(tmp_path: Path) -> None:
    write(tmp_path / "box.ttm", BOX, is_scene=False)
    simulation = bubblesim.Simulation(str(world(tmp_path, "<uri>box.ttm</uri><pose>0 0 1 0 0 0</pose>")))
    before = simulation.state_hash()
    simulation.step(10)
    assert simulation.object("/Box").position[2] < 1.5
    simulation.reset()
    assert simulation.state_hash() == before


def test_scripts_of_an_included_model_run_and_python_only_if_allowed(tmp_path: Path) -> None:
    write(tmp_path / "box.ttm", BOX, script(2, LUA), is_scene=False)
    write(tmp_path / "python.ttm", BOX, script(2, PYTHON, "python"), is_scene=False)
    file = world(tmp_path, "<uri>box.ttm</uri><name>Crate</name>", "<uri>python.ttm</uri><pose>1 0 0 0 0 0</pose>")
    run = run_sim(file, "--no-ros", "--speed", "max", "--until", "0.1")
    assert "it is Crate" in run.stdout
    assert "python runs" not in run.stdout


def test_what_is_left_out_of_an_included_model_is_listed(tmp_path: Path) -> None:
    write(tmp_path / "box.ttm", BOX, thing("GRH", 3, 2, "Graph", b""), is_scene=False)
    warnings = bubblesim.Scene(str(world(tmp_path, "<uri>box.ttm</uri>"))).warnings
    assert any("box.ttm" in each and "1 x graph: not shown (Graph)" in each for each in warnings)


@pytest.mark.parametrize(
    ("include", "inside", "reported"),
    [
        (("<uri>file://none.ttm</uri>",), "", "includes file://none.ttm, which does not exist"),
        ((), "<model name='m'><include><uri>box.ttm</uri></include></model>", "in a model: include it in the <world>"),
        (("<uri>bad.ttm</uri>",), "", "bad.ttm"),
    ],
    ids=["missing", "in a model", "damaged"],
)
def test_an_include_that_cannot_be_read_is_an_error(
    tmp_path: Path, include: tuple[str, ...], inside: str, reported: str
) -> None:
    write(tmp_path / "box.ttm", BOX, is_scene=False)
    (tmp_path / "bad.ttm").write_bytes(b"no model")
    with pytest.raises(bubblesim.SceneError, match=reported):
        bubblesim.Scene(str(world(tmp_path, *include, inside=inside)))
