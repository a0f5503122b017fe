# SPDX-License-Identifier: BSD-3-Clause
"""Models of CoppeliaSim that are added to a scene that runs, and scripts that are objects."""

import math
from pathlib import Path

import pytest

import bubblesim
from node_support import run_sim
from ttt_files import BOX, FLOOR, PYTHON, arm, cuboid, script, script_object, thing, write


def output_of(scene: Path, *options: str) -> str:
    run = run_sim(scene, "--no-ros", "--speed", "max", "--until", "0.5", *options)
    assert "error" not in run.stderr
    return run.stdout


LOADS_TWICE = """sim = require'sim'
function sysCall_init()
  first, second = sim.loadModel('robots/arm.ttm'), sim.loadModel('arm.ttm')
  print(sim.getObjectAlias(first, 2)..' '..sim.getObjectAlias(second, 2))
  print(string.format('at %.3f', sim.getJointPosition(sim.getObject('/Base[1]/motor'))))
  print(sim.getObject('/Base[1]/motor/Arm') ~= sim.getObject('/Base[0]/motor/Arm'))
  sim.removeModel(first)
  print(sim.getObject('/Base', {noError = true}) == second)
end
"""


def test_a_script_loads_a_model_by_the_name_of_its_file(tmp_path: Path) -> None:
    write(tmp_path / "arm.ttm", arm(0.5, 0, 0), is_scene=False)
    printed = output_of(write(tmp_path / "scene.ttt", FLOOR, BOX, script(2, LOADS_TWICE)))
    assert "/Base[0] /Base[1]\n" in printed
    assert "at 0.500\n" in printed
    assert printed.count("true\n") == 2


def test_a_model_that_is_added_stands_and_moves_as_in_its_file(tmp_path: Path) -> None:
    file = write(tmp_path / "arm.ttm", arm(0.5, 8, -0.25), is_scene=False)
    simulation = bubblesim.Simulation(str(write(tmp_path / "scene.ttt", BOX)))  # no floor, on which the arm would lie
    first = simulation.add_foreign_models(str(file))
    simulation.add_foreign_models(str(file))
    for base in ("/Base[0]", "/Base[1]"):
        assert simulation.object(f"{base}/motor").joint_position == pytest.approx(0.5, abs=1e-9)
        position = simulation.object(f"{base}/motor/Arm").position
        assert position[:2] == pytest.approx((0.5 * math.cos(0.5), 0.5 * math.sin(0.5)), abs=1e-9)
    for model in first:  # it is in the way of the other one
        simulation.remove_model(model.handle)
    simulation.step(60)
    assert simulation.object("/Base/motor").joint_position == pytest.approx(-0.25, abs=1e-3)
    assert "ground_plane" not in [each.name for each in simulation.objects]


def test_the_scripts_of_an_added_model_run(tmp_path: Path) -> None:
    hello = "sim = require'sim'\nfunction sysCall_init() print('it is '..sim.getObjectAlias(sim.getObject('.'))) end\n"
    write(tmp_path / "box.ttm", BOX, script(2, hello), is_scene=False)
    loads = "sim = require'sim'\nfunction sysCall_init() sim.loadModel('box.ttm') end\n"
    assert "it is Box" in output_of(write(tmp_path / "scene.ttt", FLOOR, script(1, loads)))


def test_python_of_an_added_model_runs_only_if_that_is_allowed(tmp_path: Path) -> None:
    write(tmp_path / "box.ttm", BOX, script(2, PYTHON, "python"), is_scene=False)
    loads = "sim = require'sim'\nfunction sysCall_init() sim.loadModel('box.ttm') end\n"
    scene = write(tmp_path / "scene.ttt", FLOOR, script(1, loads))
    assert "python runs" not in output_of(scene)
    assert "python runs" in output_of(scene, "--allow-python-scripts")


def test_a_model_without_shapes_is_refused(tmp_path: Path) -> None:
    file = write(tmp_path / "tip.ttm", thing("DMY", 1, -1, "Tip", b""), is_scene=False)
    simulation = bubblesim.Simulation(str(write(tmp_path / "scene.ttt", FLOOR)))
    before = simulation.state_hash()
    with pytest.raises(bubblesim.SceneError, match="no shape"):
        simulation.add_foreign_models(str(file))
    assert simulation.state_hash() == before


WHERE = """sim = require'sim'
function sysCall_init()
  print('self '..sim.getObjectAlias(sim.getObject('.'))..', parent '..sim.getObjectAlias(sim.getObject('..')))
end
function answer() return 42 end
"""
ASKS = """sim = require'sim'
function sysCall_init() end
function sysCall_actuation()
  print('answer '..sim.callScriptFunction('answer', sim.getScript(sim.scripttype_simulation, '/Box')))
end
"""


def test_a_script_object_is_self_and_acts_for_its_parent(tmp_path: Path) -> None:
    box = thing("SHP", 2, -1, "Box", cuboid((0.2, 0.2, 0.2), 2), (1, 0, 0, 0, 0, 0, 0.1))
    scene = write(tmp_path / "scene.ttt", FLOOR, box, script_object(30, 2, WHERE), script_object(31, 1, ASKS))
    printed = output_of(scene)
    assert "self Script, parent Box\n" in printed
    assert "answer 42\n" in printed


def test_a_script_object_at_the_top_and_a_second_one_run(tmp_path: Path) -> None:
    prints = "function sysCall_init() print('{}') end\n"
    objects = (script_object(30 + i, owner, prints.format(f"number {i}")) for i, owner in enumerate((-1, 1, 1)))
    printed = output_of(write(tmp_path / "scene.ttt", FLOOR, *objects))
    assert all(f"number {i}\n" in printed for i in range(3))


def test_a_script_moves_a_mark_that_the_file_attaches_to_a_body(tmp_path: Path) -> None:
    mark = thing("SHP", 3, 2, "target", cuboid((0.05, 0.05, 0.05)).replace(b"Ss3\1\0\0\0\1", b"Ss3\1\0\0\0\0"))
    frees = """sim = require'sim'
function sysCall_init()
  local mark = sim.getObject('./target')
  sim.setObjectParent(mark, -1, true)
  sim.setObjectPosition(mark, {1, 2, 3})
  print(string.format('%.0f %.0f %.0f', unpack(sim.getObjectPosition(mark))))
end
"""
    assert "1 2 3\n" in output_of(write(tmp_path / "scene.ttt", FLOOR, BOX, mark, script(2, frees)))


def test_a_model_that_reaches_below_its_origin_stands_on_a_floor_there(tmp_path: Path) -> None:
    sunk = thing("SHP", 2, -1, "Box", cuboid((0.2, 0.2, 0.2), 2), (1, 0, 0, 0, 0, 0, -0.5))
    simulation = bubblesim.Simulation(str(write(tmp_path / "box.ttm", sunk, is_scene=False)))
    simulation.step(20)
    assert simulation.object("/Box").position[2] == pytest.approx(-0.5, abs=2e-3)
