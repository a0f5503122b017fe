# SPDX-License-Identifier: BSD-3-Clause
"""sim.saveScene: what is written loads to the scene that was saved."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from bubblesim._core import add_copy, copy_model

from bubblesim import Simulation
from bubblesim.scene_state.saved_scene import scene_text, write_scene
from bubblesim.scene_state.scene_edits import SceneEdits
from node_support import write
from remote_support import RemoteNode, refusal

SCENES = ["ball", "bubblerob", "pioneer", "quadcopter", "sensors", "tricycle"]
ARM = """\
<?xml version="1.0"?>
<sdf version="{version}">
  <world name="arm">
    <!-- kept -->
    <model name="arm">
      <pose>0 0 1 0 0 0.3</pose>
      <link name="base"/>
      <link name="tip"><pose>0.5 0 0 0 0.2 0</pose></link>
      <joint name="fixed" type="fixed"><parent>world</parent><child>base</child></joint>
      <joint name="elbow" type="revolute"><parent>base</parent><child>tip</child><axis><xyz>0 0 1</xyz></axis></joint>
    </model>
    <model name="gone"><link name="link"/></model>
  </world>
</sdf>
"""
BOX = """\
<sdf version="1.9"><model name="box"><link name="link">
  <collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision>
</link></model></sdf>
"""


def saved(simulation: Any, file: Path, edits: SceneEdits | None = None) -> Any:
    write_scene(scene_text(simulation, edits or SceneEdits(), file.parent), file, overwrite=False)
    return Simulation(str(file))


@pytest.mark.parametrize("scene", SCENES)
def test_a_scene_that_was_not_changed_has_the_same_state_hash(scene: str, tmp_path: Path) -> None:
    simulation = Simulation(scene)
    again = saved(simulation, tmp_path / "saved.sdf")
    assert again.state_hash() == simulation.state_hash()
    for _ in range(10):
        simulation.step()
        again.step()
    assert again.state_hash() == simulation.state_hash()


def test_the_empty_scene_and_a_model_file_become_worlds(tmp_path: Path) -> None:
    file = write(tmp_path / "box.sdf", BOX)
    simulation = Simulation(str(file))
    again = saved(simulation, tmp_path / "world.sdf")
    for _ in range(5):
        simulation.step()
        again.step()
    assert again.state_hash() == simulation.state_hash()
    assert again.time_step == simulation.time_step


PLACES = """\
<sdf version="1.9" xmlns:bubblesim="https://bubblesim">
  <world name="places">
    <model name="robot body">
      <bubblesim:is_object>false</bubblesim:is_object>
      <pose>1 2 0 0 0 0</pose>
      <link name="base"><bubblesim:place><id>1</id></bubblesim:place></link>
      <link name="arm"><bubblesim:place><id>3</id><parent>2</parent></bubblesim:place></link>
      <joint name="motor" type="revolute">
        <parent>base</parent><child>arm</child><axis><xyz>0 0 1</xyz></axis>
        <bubblesim:place><id>2</id><parent>1</parent></bubblesim:place>
      </joint>
      <bubblesim:object name="post">
        <link>base</link><pose>0 0 1 0 0 0</pose>
        <bubblesim:place><id>4</id><parent>1</parent></bubblesim:place>
      </bubblesim:object>
    </model>
    <bubblesim:object name="goal"/>
  </world>
</sdf>
"""


def test_a_tree_that_is_not_the_nesting_of_models_is_saved(tmp_path: Path) -> None:
    simulation = Simulation(str(write(tmp_path / "places.sdf", PLACES)))
    base, post, goal = (simulation.object(path) for path in ("/base", "/post", "/goal"))
    base.position = [3, 0, 0]
    post.position = [3, 0, 2]
    goal.position = [7, 8, 9]
    again = saved(simulation, tmp_path / "saved.sdf")
    assert again.state_hash() == simulation.state_hash()
    for path, position in (("/base/motor/arm", [3, 0, 0]), ("/base/post", [3, 0, 2]), ("/goal", [7, 8, 9])):
        np.testing.assert_allclose(again.object(path).position, position, atol=1e-12)


def test_masses_and_friction_that_were_set_are_in_the_file(tmp_path: Path) -> None:
    simulation = Simulation(str(write(tmp_path / "arm.sdf", ARM.format(version="1.9"))))
    world = simulation.world
    edits = SceneEdits()
    gone, tip = world.find("/gone", -1), world.find("/arm/tip", -1)
    edits.numbers.set(world, gone, "mass", 2.5, stays=True)
    edits.numbers.set(world, tip, "mass", 0.3, stays=True)
    again = saved(simulation, tmp_path / "heavy.sdf", edits)
    assert (again.world.mass(gone), again.world.mass(tip)) == (2.5, 0.3)
    for one in (simulation, again):
        one.object("/gone").apply_wrench([0, 0, 5], [0, 0.1, 0])
        one.step(10)
    assert again.state_hash() == simulation.state_hash()


def test_friction_that_was_set_is_in_all_collisions(tmp_path: Path) -> None:
    simulation = Simulation(str(write(tmp_path / "box.sdf", BOX)))
    edits = SceneEdits()
    box = simulation.world.find("/box", -1)
    edits.numbers.set(simulation.world, box, "friction", 0.37, stays=True)
    file = tmp_path / "slippery.sdf"
    again = saved(simulation, file, edits)
    assert again.world.friction(box) == 0.37
    assert file.read_text().count("0.37") == 2  # along both directions


def test_numbers_of_an_include_have_no_place(tmp_path: Path) -> None:
    simulation = Simulation("p3dx_floor")
    edits = SceneEdits()
    edits.numbers.set(simulation.world, simulation.world.find("/PioneerP3DX", -1), "mass", 20.0, stays=True)
    with pytest.raises(ValueError, match="an <include> has no place for the mass of /PioneerP3DX/"):
        scene_text(simulation, edits, tmp_path)


@pytest.mark.parametrize("version", ["1.6", "1.9"])
def test_poses_and_joint_positions_are_those_of_the_saved_scene(version: str, tmp_path: Path) -> None:
    simulation = Simulation(str(write(tmp_path / "arm.sdf", ARM.format(version=version))))
    world = simulation.world
    elbow, gone = world.find("/elbow", -1), world.find("/gone", -1)
    world.set_joint_position(elbow, 0.7)
    world.set_pose(gone, [1, 2, 3, 0.5, 0.5, 0.5, 0.5])
    file = tmp_path / "elsewhere.sdf"
    again = saved(simulation, file)
    assert "<!-- kept -->" in file.read_text()
    assert again.world.joint_position(elbow) == pytest.approx(0.7, abs=1e-9)
    for path in ("/arm", "/arm/tip", "/gone/link"):
        handle = world.find(path, -1)
        np.testing.assert_allclose(again.world.pose(handle), world.pose(handle), atol=1e-9)
    once_more = saved(again, tmp_path / "once_more.sdf")
    for path in ("/arm/tip", "/gone/link"):
        handle = world.find(path, -1)
        np.testing.assert_allclose(once_more.world.pose(handle), world.pose(handle), atol=1e-9)


def test_added_models_are_in_the_file_and_removed_ones_are_not(tmp_path: Path) -> None:
    simulation = Simulation(str(write(tmp_path / "arm.sdf", ARM.format(version="1.9"))))
    edits = SceneEdits()
    box = simulation.add_model(BOX, name="parcel").handle
    edits.sources[box] = BOX
    simulation.world.set_pose(box, [0, 0, 0.1, 0, 0, 0, 1])
    simulation.remove_model(simulation.world.find("/gone", -1))
    again = saved(simulation, tmp_path / "saved.sdf", edits)
    assert again.object("/parcel").position.tolist() == [0, 0, 0.1]
    with pytest.raises(LookupError):
        again.object("/gone")


FURNITURE = """\
<sdf version="1.9"><model name="shelf"><static>true</static><pose>0 0 9 0 0 0</pose><link name="link">
  <visual name="v"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></visual>
</link></model></sdf>
"""


def test_copies_of_the_files_models_and_models_that_stand_still_are_in_the_file(tmp_path: Path) -> None:
    simulation = Simulation("tricycle")
    world = simulation.world
    edits = SceneEdits()
    tricycle = world.find("/Tricycle", -1)
    copy = add_copy(simulation, copy_model(simulation, tricycle), "Tricycle_1", [3, 0, 0.2], [0, 0, 1, 0])
    edits.originals[copy] = "Tricycle"
    shelf = simulation.add_model(FURNITURE, name="shelf_2", position=[1, 2, 0.5]).handle
    edits.sources[shelf] = FURNITURE
    simulation.remove_model(tricycle)
    edits.remove({tricycle})
    again = saved(simulation, tmp_path / "saved.sdf", edits)
    for path in ("/Tricycle_1", "/Tricycle_1/FrontMotor", "/shelf_2"):
        pose = world.pose(world.find(path, -1))
        np.testing.assert_allclose(again.world.pose(again.world.find(path, -1)), pose, atol=1e-9)
    assert again.world.is_static(again.world.find("/shelf_2", -1))
    with pytest.raises(LookupError):
        again.object("/Tricycle")


def test_what_a_file_cannot_contain_is_an_error(tmp_path: Path) -> None:
    simulation = Simulation("ball")
    ball = simulation.world.find("/Ball", -1)
    file = tmp_path / "saved.sdf"
    with pytest.raises(ValueError, match="a file has no place for the name 'round' of /Ball"):
        saved(simulation, file, SceneEdits(names={ball: "round"}))
    simulation.add_model(BOX, name="parcel")
    with pytest.raises(ValueError, match="/parcel was added by another program"):
        saved(simulation, file)
    assert list(tmp_path.iterdir()) == []


def test_a_file_is_not_overwritten_without_the_flag(tmp_path: Path) -> None:
    file = write(tmp_path / "mine.sdf", "mine\n")
    simulation = Simulation("ball")
    with pytest.raises(FileExistsError, match="exists"):
        saved(simulation, file)
    assert file.read_text() == "mine\n"
    assert [each.name for each in tmp_path.iterdir()] == ["mine.sdf"]
    write_scene(scene_text(simulation, SceneEdits(), file.parent), file, overwrite=True)
    assert Simulation(str(file)).state_hash() == simulation.state_hash()


def test_trusted_clients_save_scenes(tmp_path: Path) -> None:
    file = tmp_path / "saved.ttt"
    with RemoteNode(tmp_path, "--remote-trusted", scene="") as node:
        sim = node.sim()
        cube = sim.createPrimitiveShape(sim.primitiveshape_cuboid, [0.1, 0.1, 0.1])
        sim.setObjectPosition(cube, [1, 2, 3])
        sim.setShapeColor(cube, None, sim.colorcomponent_ambient_diffuse, [1, 0, 0])
        sim.startSimulation()
        assert "stop the simulation first" in refusal(sim.saveScene, str(file))
        sim.stopSimulation()
        assert sim.saveScene(str(file)) == 1
        assert sim.loadScene(str(file)) == 1
        cube = sim.getObject("/Cuboid")
        assert sim.getObjectPosition(cube) == pytest.approx([1, 2, 3])
        assert sim.getShapeColor(cube, None, sim.colorcomponent_ambient_diffuse)[1] == [1, 0, 0]
        assert sim.getObjectInt32Param(cube, sim.shapeintparam_static) == 1
    with RemoteNode(tmp_path) as node:
        assert "--remote-trusted" in refusal(node.sim().saveScene, str(tmp_path / "other.sdf"))


def test_colours_that_were_set_are_saved(tmp_path: Path) -> None:
    visual = '<visual name="v"><geometry><sphere><radius>1</radius></sphere></geometry>{}</visual>'
    grey = "<material><diffuse>.5 .5 .5 1</diffuse><emissive>1 1 1 1</emissive></material>"
    inner = f'<model name="arm"><link name="link">{visual.format(grey)}</link></model>'
    text = f'<sdf version="1.9"><model name="robot"><link name="link">{visual.format("")}</link>{inner}</model></sdf>'
    simulation = Simulation(str(write(tmp_path / "robot.sdf", text)))
    edits = SceneEdits()
    edits.colours.set(simulation, simulation.object("/robot").handle, [1, 0, 0])
    edits.colours.set(simulation, simulation.object("/robot/arm").handle, [0, 0.25, 0.75])
    again = saved(simulation, tmp_path / "saved.sdf", edits)
    colours = [list(again.color(again.object(path).handle)) for path in ("/robot/link", "/robot/arm")]
    assert colours == [[1, 0, 0], [0, 0.25, 0.75]]
    assert "emissive" not in (tmp_path / "saved.sdf").read_text()
