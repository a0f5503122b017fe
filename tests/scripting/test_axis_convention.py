# SPDX-License-Identifier: BSD-3-Clause
"""<bubblesim:axis_convention>: the axes in which scripts see joints, proximity sensors and cameras."""

from pathlib import Path

import pytest

from node_support import in_init, run_script, write

SCENE = """\
<sdf version="1.9" xmlns:bubblesim="https://bubblesim">
  <world name="axes">
    <bubblesim:axis_convention>{convention}</bubblesim:axis_convention>
    <model name="Wall">
      <static>true</static><pose>3.05 0 1 0 0 0</pose>
      <link name="link">
        <collision name="box"><geometry><box><size>0.1 4 2</size></box></geometry></collision>
      </link>
    </model>
    <model name="Robot">
      <pose>0 0 1 0 0 0</pose>
      <link name="base">
        <sensor name="sonar" type="sonar">
          <pose>0.5 0 0 0 0 0</pose>
          <sonar><min>0</min><max>5</max><radius>0</radius></sonar>
        </sensor>
        <sensor name="camera" type="camera"><pose>0 0 0.1 0 0 1.5707963267948966</pose></sensor>
        <sensor name="imu" type="imu"/>
      </link>
      <link name="slider"><pose>0.2 0 0 0 0 0</pose></link>
      <link name="head"/>
      <joint name="slide" type="prismatic">
        <pose relative_to="slider"/>
        <parent>base</parent><child>slider</child>
        <axis><xyz>1 0 0</xyz><bubblesim:motor>position</bubblesim:motor></axis>
      </joint>
      <joint name="neck" type="universal">
        <parent>base</parent><child>head</child>
        <axis><xyz>1 0 0</xyz></axis><axis2><xyz>0 1 0</xyz></axis2>
      </joint>
      <joint name="hold" type="fixed"><parent>world</parent><child>base</child></joint>
    </model>
  </world>
</sdf>
"""

HEADER = """
import numpy as np
def near(found, expected):
    np.testing.assert_allclose(found, expected, atol=1e-6)
def axes_of(path):
    return np.array(sim.getObjectMatrix(sim.getObject(path))).reshape(3, 4)[:, :3]
x, y, z = np.eye(3)
def columns(*axes):
    return np.array(axes).T
"""


def check(folder: Path, convention: str, body: str) -> None:
    scene = write(folder / "axes.sdf", SCENE.format(convention=convention))
    run = run_script(folder, HEADER + in_init(body), "--strict", scene=str(scene), target="/Robot")
    assert (run.stderr, run.returncode) == ("", 0)


def test_sensors_look_along_z_and_joints_have_it_as_their_axis(tmp_path: Path) -> None:
    body = """
near(axes_of('/sonar'), columns(y, z, x))  # x to the left, y up, z forward
near(axes_of('/camera'), columns(-x, z, y))
near(axes_of('/slide'), columns(-z, y, x))
near(axes_of('/neck'), columns(-z, y, x))
near(axes_of('/neck/axis2'), columns(x, -z, y))
for path in ('/imu', '/Robot', '/base', '/hold', '/Wall/link'):
    near(axes_of(path), np.eye(3))
"""
    check(tmp_path, "coppeliasim", body)


def test_without_it_scripts_see_the_axes_of_the_file(tmp_path: Path) -> None:
    body = """
for path in ('/sonar', '/slide', '/neck', '/neck/axis2', '/imu'):
    near(axes_of(path), np.eye(3))
near(axes_of('/camera'), columns(y, -x, z))
result, distance, point, seen, normal = sim.handleProximitySensor(sim.getObject('/sonar'))
near([distance, *point, *normal], [2.5, 2.5, 0, 0, -1, 0, 0])
"""
    check(tmp_path, "sdformat", body)


def test_readings_and_relative_poses_have_the_same_axes(tmp_path: Path) -> None:
    body = """
sonar, slide, slider = (sim.getObject(f'/{name}') for name in ('sonar', 'slide', 'slider'))
result, distance, point, seen, normal = sim.handleProximitySensor(sonar)
near([distance, *point, *normal], [2.5, 0, 0, 2.5, 0, 0, -1])
near(sim.readProximitySensor(sonar)[2], point)
near(sim.multiplyVector(sim.getObjectMatrix(sonar), point), [3, 0, 1])
near(sim.getObjectPosition(sim.getObject('/Wall/link'), sonar), [0, 0, 2.55])
sim.setJointPosition(slide, 0.3)
near(sim.getObjectPosition(slide), [0.2, 0, 1])
near(sim.getObjectPosition(slider, slide), [0, 0, 0])  # the frame of a joint moves with its child
tip = sim.createDummy(0.01)
sim.setObjectParent(tip, slide, False)
sim.setObjectPosition(tip, [0, 0, 0.1], sim.handle_parent)
near(sim.getObjectPosition(tip), [0.6, 0, 1])
sim.setObjectPosition(tip, [0, 0, 1], sonar)
near(sim.getObjectPosition(tip), [1.5, 0, 1])
near(sim.getObjectPosition(tip, slide), [0, 0, 1])
"""
    check(tmp_path, "coppeliasim", body)


@pytest.mark.parametrize("convention", ["sdformat", "coppeliasim"])
def test_collections_limit_what_a_sensor_detects(tmp_path: Path, convention: str) -> None:
    body = """
sonar, wall = sim.getObject('/sonar'), sim.getObject('/Wall')
others = sim.createCollection(0)
sim.addItemToCollection(others, sim.handle_all, -1, 0)
sim.addItemToCollection(others, sim.handle_tree, sim.getObject('/Robot'), 1)
assert sim.getCollectionObjects(others) == [wall, sim.getObject('/Wall/link')]
assert sim.getObjectInt32Param(sonar, sim.proxintparam_entity_to_detect) == sim.handle_all
sim.setObjectInt32Param(sonar, sim.proxintparam_entity_to_detect, others)
assert sim.handleProximitySensor(sonar)[0] == 1 and sim.readProximitySensor(sonar)[0] == 1
sim.addItemToCollection(others, sim.handle_single, sim.getObject('/Wall/link'), 1)
assert sim.readProximitySensor(sonar) == (0, 0.0, [0, 0, 0], -1, [0, 0, 0])
assert sim.checkProximitySensor(sonar, wall)[0] == 1 and sim.checkProximitySensor(sonar, others)[0] == 0
sim.setObjectInt32Param(sonar, sim.proxintparam_entity_to_detect, wall)
assert sim.readProximitySensor(sonar)[0] == 1
chain = sim.createCollection(0)
sim.addItemToCollection(chain, sim.handle_chain, sonar, 2)
assert sim.getCollectionObjects(chain) == [sim.getObject('/Robot'), sim.getObject('/base')]
sim.setObjectInt32Param(sonar, sim.proxintparam_entity_to_detect, chain)
assert sim.readProximitySensor(sonar)[0] == 0
sim.destroyCollection(chain)
assert sim.readProximitySensor(sonar)[0] == 1
def refused(call, *arguments):
    try:
        call(*arguments)
    except (ValueError, LookupError) as error:
        return str(error)
assert 'no collection has the handle' in refused(sim.getCollectionObjects, chain)
assert 'use sim.handle_all' in refused(sim.addItemToCollection, others, 5, wall, 0)
assert 'is neither an object nor' in refused(sim.setObjectInt32Param, sonar, sim.proxintparam_entity_to_detect, chain)
assert 'not a sensor' in refused(sim.setObjectInt32Param, wall, sim.proxintparam_entity_to_detect, others)
"""
    check(tmp_path, convention, body)
