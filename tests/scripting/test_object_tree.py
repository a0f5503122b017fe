# SPDX-License-Identifier: BSD-3-Clause
"""Scripts walk a tree that is not the nesting of the file: joints are the parents of what they move."""

from pathlib import Path

from node_support import REFUSED, in_init, run_script, write

SCENE = """\
<sdf version="1.9" xmlns:bubblesim="https://bubblesim">
  <world name="places">
    <gravity>0 0 0</gravity>
    <model name="robot body">
      <bubblesim:is_object>false</bubblesim:is_object>
      <pose>1 2 0 0 0 0</pose>
      <link name="base">
        <bubblesim:alias>Robot</bubblesim:alias>
        <bubblesim:place><id>1</id><model>true</model></bubblesim:place>
        <sensor name="eye_0" type="sonar">
          <bubblesim:alias>eye</bubblesim:alias>
          <bubblesim:place><id>2</id><parent>5</parent></bubblesim:place>
          <sonar><min>0</min><max>5</max><radius>0.1</radius></sonar>
        </sensor>
        <sensor name="eye_1" type="sonar">
          <bubblesim:alias>eye</bubblesim:alias>
          <bubblesim:place><id>3</id><parent>5</parent></bubblesim:place>
          <sonar><min>0</min><max>5</max><radius>0.1</radius></sonar>
        </sensor>
      </link>
      <link name="wheel">
        <pose>0.5 0 0 0 0 0</pose>
        <bubblesim:place><id>7</id><parent>4</parent></bubblesim:place>
      </link>
      <joint name="motor" type="revolute">
        <pose relative_to="wheel"/>
        <parent>base</parent><child>wheel</child><axis><xyz>0 0 1</xyz></axis>
        <bubblesim:place><id>4</id><parent>1</parent></bubblesim:place>
      </joint>
      <bubblesim:object name="post">
        <link>base</link><pose>0 0 1 0 0 0</pose>
        <bubblesim:place><id>5</id><parent>1</parent><order>1</order></bubblesim:place>
      </bubblesim:object>
      <bubblesim:object name="rim">
        <kind>shape</kind><link>wheel</link><pose>0.1 0 0 0 0 0</pose>
        <bubblesim:place><id>6</id><parent>7</parent></bubblesim:place>
      </bubblesim:object>
    </model>
    <model name="load body">
      <bubblesim:is_object>false</bubblesim:is_object>
      <pose>1 2 3 0 0 0</pose>
      <link name="load"><bubblesim:place><id>8</id><parent>1</parent><order>2</order></bubblesim:place></link>
    </model>
    <bubblesim:object name="goal#0">
      <pose>4 0 0 0 0 0</pose>
      <bubblesim:alias>goal</bubblesim:alias>
      <bubblesim:place><id>9</id></bubblesim:place>
    </bubblesim:object>
    <bubblesim:object name="view">
      <kind>camera</kind>
      <bubblesim:place><id>10</id></bubblesim:place>
    </bubblesim:object>
  </world>
</sdf>
"""

HEADER = f"""
import math
import numpy as np
near = lambda a, b: np.testing.assert_allclose(a, b, atol=1e-9)
def names(handles):
    return [sim.getObjectAlias(handle) for handle in handles]
{REFUSED}"""


def check(folder: Path, body: str, target: str = "/Robot/motor/wheel", rest: str = "", name: str = "script.py") -> str:
    """Run `body` as a script of the wheel; an error fails the test. Return what it printed."""
    scene = write(folder / "places.sdf", SCENE)
    code = f"{HEADER}{in_init(body)}{rest}" if name.endswith(".py") else body
    run = run_script(folder, code, "--strict", scene=str(scene), target=target, name=name)
    assert (run.stderr, run.returncode) == ("", 0)
    return run.stdout


def test_paths_lead_through_joints(tmp_path: Path) -> None:
    body = """
robot, wheel = sim.getObject('/Robot'), sim.getObject('/Robot/motor/wheel')
assert sim.getObject('.') == sim.getObject('/wheel') == wheel == sim.getObjectHandle(sim.handle_self)
assert sim.getObject('..') == sim.getObject('/motor') == sim.getObjectParent(wheel)
assert sim.getObject('../..') == sim.getObject(':') == robot
assert sim.getObject('./rim') == sim.getObject(':/rim') == sim.getObject('../../motor/wheel/rim')
assert sim.getObject('/eye[1]') == sim.getObject(':/eye', {'index': 1}) == sim.getObject('/Robot/post/eye[1]')
assert sim.getObjectAlias(sim.getObject('./rim'), 2) == '/Robot/motor/wheel/rim'
assert 'no object matches' in refused(sim.getObject, '/robot body')
assert sim.getObject('..', {'proxy': robot}) == robot  # at the top
assert sim.getObject('../post', {'proxy': robot}) == sim.getObject('/post')
"""
    check(tmp_path, body)


def test_scripts_walk_down_in_the_order_of_the_file(tmp_path: Path) -> None:
    body = """
robot = sim.getObject('/Robot')
children = lambda handle: [sim.getObjectChild(handle, i) for i in range(9) if sim.getObjectChild(handle, i) >= 0]
assert names(children(robot)) == ['motor', 'post', 'load']
assert names(children(sim.getObject('/post'))) == ['eye', 'eye']
assert names(children(-1)) == ['Robot', 'goal', 'view']
assert names(sim.getObjectsInTree(robot)) == ['Robot', 'motor', 'wheel', 'rim', 'post', 'eye', 'eye', 'load']
assert names(sim.getObjectsInTree(robot, sim.handle_all, 1)) == names(sim.getObjectsInTree(robot))[1:]
assert names(sim.getObjectsInTree(robot, sim.handle_all, 3)) == ['motor', 'post', 'load']
assert names(sim.getObjectsInTree(robot, sim.object_joint_type)) == ['motor']
assert names(sim.getObjectsInTree(robot, sim.object_shape_type)) == ['Robot', 'wheel', 'rim', 'load']
assert names(sim.getObjectsInTree(sim.handle_scene, sim.object_dummy_type)) == ['post', 'goal']
assert sim.getObjectType(sim.getObject('/view')) == sim.object_camera_type
assert sim.getModelProperty(robot) == 0 and sim.getModelProperty(sim.getObject('/wheel')) == sim.modelproperty_not_model
"""
    check(tmp_path, body)


def test_old_names_find_the_objects_of_the_own_copy(tmp_path: Path) -> None:
    body = """
goal = sim.getObject('/goal')
assert goal == sim.getObjectHandle('goal#0') == sim.getObjectHandle('goal') == sim.getObjectHandle('goal#')
assert goal == sim.getObjectHandle('.') and sim.getObjectHandle('eye_1') == sim.getObject('/eye[1]')
assert 'no object matches' in refused(sim.getObjectHandle, 'goal#1')
"""
    check(tmp_path, body, target="/goal")


def test_poses_relative_to_the_parent_use_a_joints_moving_frame(tmp_path: Path) -> None:
    body = """
wheel, motor, rim = (sim.getObject(path) for path in ('.', '/motor', '/rim'))
near(sim.getObjectPosition(wheel), [1.5, 2, 0])
near(sim.getObjectPose(wheel, sim.handle_parent), [0, 0, 0, 0, 0, 0, 1])
sim.setJointPosition(motor, math.pi / 2)
near(sim.getObjectPosition(rim), [1.5, 2.1, 0])
near(sim.getObjectPosition(rim, wheel), [0.1, 0, 0])
near(sim.getObjectPosition(rim, motor), [0.1, 0, 0])
near(sim.getObjectOrientation(rim), [0, 0, math.pi / 2])
"""
    check(tmp_path, body)


def test_what_is_below_an_object_moves_along(tmp_path: Path) -> None:
    body = """
sim.setObjectPose(sim.getObject('/Robot'), [0, 0, 5, 0, 0, math.sqrt(0.5), math.sqrt(0.5)])
near(sim.getObjectPosition(sim.getObject('/wheel')), [0, 0.5, 5])
near(sim.getObjectPosition(sim.getObject('/rim')), [0, 0.6, 5])
near(sim.getObjectPosition(sim.getObject('/load')), [0, 0, 8])
near(sim.getObjectPosition(sim.getObject('/post')), [0, 0, 6])
near(sim.getObjectPosition(sim.getObject('/goal')), [4, 0, 0])
"""
    check(tmp_path, body)


def test_free_bodies_and_dummies_get_other_parents(tmp_path: Path) -> None:
    body = """
load, goal, motor, robot = (sim.getObject(path) for path in ('/load', '/goal', '/motor', '/Robot'))
sim.setObjectParent(load, -1, True)
near(sim.getObjectPosition(load), [1, 2, 3])
sim.setObjectParent(load, sim.getObject('/wheel'), False)  # the pose in the parent is kept
near(sim.getObjectPosition(load), [2.5, 4, 3])
sim.setObjectParent(goal, motor, True)
near(sim.getObjectPosition(goal), [4, 0, 0])
sim.setJointPosition(motor, math.pi)  # half a turn about (1.5, 2)
near(sim.getObjectPosition(goal), [-1, 4, 0])
assert 'is a part of /Robot and stays there' in warned(sim.setObjectParent, sim.getObject('/wheel'), -1)
assert 'is a part of /Robot and stays there' in warned(sim.setObjectParent, sim.getObject('/rim'), robot)
assert 'cannot be attached to itself' in refused(sim.setObjectParent, robot, motor)
"""
    check(tmp_path, body)


def test_copies_are_where_the_originals_are(tmp_path: Path) -> None:
    rest = """
def sysCall_actuation():
    if sim.getSimulationTime() > 0:
        return
    load, goal = sim.getObject('/load'), sim.getObject('/goal')
    sim.setObjectParent(goal, load, True)
    first, second = sim.copyPasteObjects([load, goal])
    near(sim.getObjectPosition(first), [1, 2, 3])
    near(sim.getObjectPosition(second), [4, 0, 0])
    assert sim.getObjectParent(first) == -1 and sim.getObjectParent(second) == first
    assert sim.getObject('/load', {'index': 1}) == load and sim.getObject('/load/goal') == second  # nearest to the top
    sim.setObjectPosition(first, [0, 0, 0])
    near(sim.getObjectPosition(load), [1, 2, 3])
    near(sim.getObjectPosition(second), [3, -2, -3])
    tree = sim.copyPasteObjects([sim.getObject('/Robot')], 1)[0]
    assert names(sim.getObjectsInTree(tree)) == names(sim.getObjectsInTree(sim.getObject('/Robot')))
    assert 'cannot be copied on its own' in refused(sim.copyPasteObjects, [sim.getObject('/motor')])
"""
    check(tmp_path, "pass", rest=rest)


def test_free_bodies_are_removed_and_parts_are_not(tmp_path: Path) -> None:
    body = """
load = sim.getObject('/load')
assert 'cannot be removed on its own' in warned(sim.removeObjects, [sim.getObject('/motor')])
assert 'cannot be removed on its own' in warned(sim.removeObjects, [sim.getObject('/goal')])
sim.removeObjects([load])
assert not sim.isHandle(load) and sim.getObject('/load', {'noError': True}) == -1
"""
    check(tmp_path, body)


def test_a_dummy_of_the_file_is_painted_and_has_a_velocity(tmp_path: Path) -> None:
    body = """
goal = sim.getObject('/goal')
sim.setObjectColor(goal, 0, sim.colorcomponent_ambient_diffuse, [1, 0, 0])
assert sim.getObjectColor(goal, 0, sim.colorcomponent_ambient_diffuse) == [1, 0, 0]
assert sim.getObjectVelocity(goal) == ([0, 0, 0], [0, 0, 0])
assert not sim.isDynamicallyEnabled(goal) and sim.getDummySize(goal) > 0
"""
    check(tmp_path, body)


def test_lua_walks_the_tree_too(tmp_path: Path) -> None:
    code = """
        function sysCall_init()
          local robot, wheel = sim.getObject('/Robot'), sim.getObject('.')
          assert(sim.getObject('..') == sim.getObject('/Robot/motor'))
          assert(sim.getObjectHandle(sim.handle_self) == wheel)
          assert(sim.getObject('./rim') == sim.getObjectChild(wheel, 0))
          assert(sim.getObjectChild(wheel, 1) == -1)
          assert(sim.getObject(':/eye', {index = 1}) == sim.getObject('/eye[1]'))
          assert(#sim.getObjectsInTree(robot) == 8)
          sim.setJointPosition(sim.getObject('..'), math.pi / 2)
          local p = sim.getObjectPosition(sim.getObject('./rim'))
          assert(math.abs(p[1] - 1.5) < 1e-9 and math.abs(p[2] - 2.1) < 1e-9)
          sim.setObjectParent(sim.getObject('/goal'), wheel, true)
          assert(sim.getObject('./goal') == sim.getObject('/goal'))
        end
    """
    check(tmp_path, code, name="script.lua")
