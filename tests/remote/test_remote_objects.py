# SPDX-License-Identifier: BSD-3-Clause
"""Objects that clients create, name, attach, paint and remove."""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from node_support import write
from remote_support import RemoteNode, refusal, warning

WORLD = """\
<?xml version="1.0"?>
<sdf version="1.9">
  <world name="room">
    <model name="floor">
      <static>true</static>
      <link name="link"><collision name="c"><geometry><plane/></geometry></collision></link>
    </model>
    <model name="cart">
      <pose>2 0 0.5 0 0 0</pose>
      <link name="body">
        <gravity>false</gravity>
        <collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision>
      </link>
      <link name="hand"><pose>0 0 0.5 0 0 0</pose><gravity>false</gravity></link>
      <joint name="wrist" type="fixed">
        <parent>body</parent><child>hand</child><sensor name="grip" type="force_torque"/>
      </joint>
    </model>
    <model name="box">
      <pose>0 0 0.1 0 0 0</pose>
      <link name="link">
        <inertial><mass>1</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial>
        <collision name="c"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision>
        <visual name="v">
          <geometry><box><size>0.2 0.2 0.2</size></box></geometry>
          <material><diffuse>0.25 0.5 0.75 1</diffuse></material>
        </visual>
      </link>
    </model>
    <model name="eye">
      <static>true</static>
      <pose>-1 0 0.1 0 0 0</pose>
      <link name="link">
        <sensor name="camera" type="camera">
          <camera><image><width>16</width><height>16</height></image><horizontal_fov>0.3</horizontal_fov></camera>
        </sensor>
      </link>
    </model>
    <bubblesim:object name="goal"><pose>5 0 0 0 0 0</pose></bubblesim:object>
  </world>
</sdf>
"""


@pytest.fixture
def sim(tmp_path: Path) -> Iterator[Any]:
    with RemoteNode(tmp_path, "--speed", "max", scene=str(write(tmp_path / "room.sdf", WORLD))) as node:
        yield node.sim()
        assert node.process.poll() is None, node.output


def run(sim: Any, seconds: float) -> None:
    sim.setStepping(True)
    sim.startSimulation()
    while sim.getSimulationTime() < seconds - 1e-6:
        sim.step()


def test_the_scenes_own_objects_are_renamed(sim: Any) -> None:
    box = sim.getObject("/box")
    sim.setObjectAlias(box, "parcel")
    assert sim.getObject("/parcel") == box
    assert sim.getObjectAlias(sim.getObject("/parcel/link"), 2) == "/parcel/link"
    assert "no object matches '/box'" in refusal(sim.getObject, "/box")
    sim.setObjectAlias(sim.getObject("/cart"), "parcel")
    assert sim.getObject("/parcel[1]") == box
    assert sim.getObject("/parcel", {"index": 1}) == box
    sim.startSimulation()
    sim.setObjectAlias(box, "for now")
    sim.stopSimulation()
    assert sim.getObjectAlias(box) == "parcel"
    assert "is not a name" in refusal(sim.setObjectAlias, box, "a/b")


def test_an_attached_model_moves_with_its_parent_when_that_is_set(sim: Any) -> None:
    box, cart = sim.getObject("/box"), sim.getObject("/cart")
    sim.setObjectParent(box, cart, True)
    assert sim.getObjectParent(box) == cart
    assert sim.getObject("/cart/box") == box
    assert sim.getObjectAlias(box, 2) == "/cart/box"
    assert box in sim.getObjectsInTree(cart)
    assert sim.getObjectPosition(box, sim.handle_parent) == pytest.approx([-2, 0, -0.4])
    sim.setObjectPose(cart, [2, 0, 0.5, 0, 0, math.sqrt(0.5), math.sqrt(0.5)])  # a quarter turn
    assert sim.getObjectPosition(box) == pytest.approx([2, -2, 0.1])
    sim.setObjectParent(box, -1, True)
    assert sim.getObjectPosition(box) == pytest.approx([2, -2, 0.1])
    sim.setObjectPosition(box, [1, 0, 0.1])
    sim.setObjectParent(box, cart, False)  # the pose relative to the world is now that relative to the cart
    assert sim.getObjectPosition(box, cart) == pytest.approx([1, 0, 0.1])


def test_wrong_parents_are_refused(sim: Any) -> None:
    box, cart = sim.getObject("/box"), sim.getObject("/cart")
    sim.setObjectParent(box, sim.getObject("/cart/hand"), True)
    assert "cannot be attached to itself or to what is attached to it" in refusal(sim.setObjectParent, cart, box, True)
    assert "is a part of /cart" in warning(sim, sim.setObjectParent, sim.getObject("/cart/hand"), -1, True)
    assert "no object has the handle 4711" in refusal(sim.setObjectParent, box, 4711, True)


def test_a_stop_puts_a_dummy_of_the_file_back(sim: Any) -> None:
    goal, box = sim.getObject("/goal"), sim.getObject("/box")
    sim.setObjectPosition(goal, [4, 0, 0])  # while it is stopped: that stays
    sim.startSimulation()
    sim.setObjectParent(goal, box, True)
    sim.setObjectAlias(goal, "mark")
    sim.setObjectPosition(goal, [9, 0, 0])
    assert sim.getObject("/box/mark") == goal
    sim.stopSimulation()
    assert (sim.getObjectParent(goal), sim.getObject("/goal")) == (-1, goal)
    np.testing.assert_allclose(sim.getObjectPosition(goal), [4, 0, 0], atol=1e-9)


def test_a_force_sensor_holds_what_is_attached_to_it(sim: Any) -> None:
    box, cart = sim.getObject("/box"), sim.getObject("/cart")
    run(sim, 0.5)
    sim.setObjectPosition(box, [2, 0, 1.3])
    sim.setObjectParent(box, sim.getObject("/cart/grip"), True)
    sim.setObjectPosition(cart, [0, 3, 0.5])
    assert sim.getObjectPosition(box) == pytest.approx([0, 3, 1.3])
    for _ in range(20):
        sim.step()
        assert sim.getObjectPosition(box) == pytest.approx([0, 3, 1.3], abs=1e-6)
    sim.setObjectParent(box, -1, True)
    sim.setObjectPosition(box, [3, 3, 1.3])
    for _ in range(40):
        sim.step()
    assert sim.getObjectPosition(box)[2] < 0.15  # it has fallen
    sim.stopSimulation()
    assert sim.getObjectParent(box) == -1
    assert sim.getObjectPosition(box) == pytest.approx([0, 0, 0.1])


def test_a_static_model_stands_still_and_falls_again(sim: Any) -> None:
    box = sim.getObject("/box")
    sim.setObjectPosition(box, [0, 0, 2])
    sim.setObjectInt32Param(box, sim.shapeintparam_static, 1)
    assert sim.getObjectInt32Param(box, sim.shapeintparam_static) == 1
    run(sim, 0.5)
    assert sim.getObjectPosition(box) == pytest.approx([0, 0, 2], abs=1e-6)
    assert sim.isDynamicallyEnabled(box) is False
    sim.setObjectInt32Param(box, sim.shapeintparam_static, 0)
    for _ in range(10):
        sim.step()
    assert sim.getObjectPosition(box)[2] == pytest.approx(2 - 9.81 / 2 * 0.25, rel=0.05)
    sim.stopSimulation()
    assert sim.getObjectInt32Param(box, sim.shapeintparam_static) == 1  # as before the run
    floor = sim.getObject("/floor")
    assert "static in the scene's file" in warning(sim, sim.setObjectInt32Param, floor, sim.shapeintparam_static, 0)


def test_poses_that_are_set_while_stopped_stay(sim: Any) -> None:
    box = sim.getObject("/box")
    sim.setObjectPosition(box, [0, 4, 0.1])
    for _ in range(2):
        sim.startSimulation()
        sim.setObjectPosition(box, [0, 5, 0.1])
        sim.stopSimulation()
        assert sim.getObjectPosition(box) == pytest.approx([0, 4, 0.1])


def test_a_created_shape_is_static_and_not_respondable_at_first(sim: Any) -> None:
    cube = sim.createPrimitiveShape(sim.primitiveshape_cuboid, [0.2, 0.2, 0.2])
    assert sim.getObject("/Cuboid") == cube
    assert sim.getObjectType(cube) == sim.object_shape_type
    sim.setObjectPosition(cube, [0, 0, 1.0])  # above the box
    assert sim.getObjectInt32Param(cube, sim.shapeintparam_static) == 1
    assert sim.getObjectInt32Param(cube, sim.shapeintparam_respondable) == 0
    run(sim, 0.5)
    assert sim.getObjectPosition(cube) == pytest.approx([0, 0, 1], abs=1e-9)
    sim.stopSimulation()
    assert sim.getObjectPosition(cube) == pytest.approx([0, 0, 1])
    sim.setObjectInt32Param(cube, sim.shapeintparam_static, 0)
    sim.setObjectInt32Param(cube, sim.shapeintparam_respondable, 1)
    assert sim.isHandle(cube)
    assert sim.getObject("/Cuboid") == cube
    assert sim.getShapeMass(cube) == pytest.approx(8.0)
    run(sim, 2.0)
    assert sim.getObjectPosition(cube)[2] == pytest.approx(0.3, abs=0.01)  # it lies on the box
    sim.stopSimulation()
    assert sim.getObjectPosition(cube) == pytest.approx([0, 0, 1])
    sim.removeObjects([cube])
    assert not sim.isHandle(cube)


def test_a_shape_that_is_not_respondable_falls_through_the_floor(sim: Any) -> None:
    ball = sim.createPureShape(1, 0, [0.1, 0.1, 0.1], 2.0)
    sim.setObjectPosition(ball, [0, 2, 0.5])
    run(sim, 1.0)
    assert sim.getObjectPosition(ball)[2] < -1
    assert sim.getShapeMass(ball) == 2.0


@pytest.mark.parametrize(
    ("kind", "sizes"), [(1, [1, 2, 0]), (2, [1, 1, 0]), (4, [1, 2, 3]), (5, [1, 1, 2]), (8, [1, 1, 3])]
)
def test_all_kinds_of_shapes_are_created(sim: Any, kind: int, sizes: list[float]) -> None:
    shape = sim.createPrimitiveShape(kind, sizes)
    sim.setObjectAlias(shape, "mine")
    sim.setShapeMass(shape, 3.0)
    sim.setObjectInt32Param(shape, sim.shapeintparam_respondable, 1)
    assert sim.getObject("/mine") == shape
    assert sim.getShapeMass(shape) == 3.0


def test_shapes_without_sense_are_refused(sim: Any) -> None:
    assert "not a supported primitive shape" in refusal(
        sim.createPrimitiveShape, sim.primitiveshape_heightfield, [1, 1, 1]
    )
    assert "three lengths" in refusal(sim.createPrimitiveShape, sim.primitiveshape_cuboid, [1, 1, 0])
    assert "equal sizes along x and y" in refusal(sim.createPrimitiveShape, sim.primitiveshape_cylinder, [1, 2, 1])
    box = sim.getObject("/box")
    assert "collides as the scene's file defines" in warning(
        sim, sim.setObjectInt32Param, box, sim.shapeintparam_respondable, 0
    )


def seen(sim: Any) -> np.ndarray:
    data, size = sim.getVisionSensorImg(sim.getObject("/camera"))
    sim.handleVisionSensor(sim.getObject("/camera"))
    data, size = sim.getVisionSensorImg(sim.getObject("/camera"))
    return np.frombuffer(data, np.uint8).reshape(size[1], size[0], 3)[8, 8].astype(float)


def test_colours_are_seen_by_cameras(sim: Any) -> None:
    box = sim.getObject("/box")
    assert sim.getShapeColor(box, None, sim.colorcomponent_ambient_diffuse) == (1, [0.25, 0.5, 0.75])
    before = seen(sim)
    assert before[2] > 1.5 * before[0]
    sim.setShapeColor(box, None, sim.colorcomponent_ambient_diffuse, [1, 0, 0])
    assert sim.getShapeColor(box, None, sim.colorcomponent_ambient_diffuse) == (1, [1, 0, 0])
    after = seen(sim)
    assert after[0] > 100
    assert after[2] < 5
    assert "from 0 to 1" in refusal(sim.setShapeColor, box, None, sim.colorcomponent_ambient_diffuse, [2, 0, 0])
    grip = sim.getObject("/grip")
    assert "has no colour" in warning(sim, sim.setShapeColor, grip, None, sim.colorcomponent_ambient_diffuse, [1, 0, 0])


def test_the_models_of_a_scene_are_removed(sim: Any) -> None:
    box, cart = sim.getObject("/box"), sim.getObject("/cart")
    sim.setObjectParent(box, cart, True)
    sim.removeObjects([cart])
    assert sim.getObjectParent(box) == -1
    assert "remove the whole model" in warning(sim, sim.removeObject, sim.getObject("/box/link"))
    sim.startSimulation()
    sim.wait(0.2)


# Functions that 135 public programs call, from the most frequent on, with the number of programs whose functions all
# exist once those of the line exist, too.
PUBLIC = {
    57: "getObject startSimulation stopSimulation getObjectPosition getSimulationState setJointTargetVelocity "
    "getObjectOrientation setObjectPosition setObjectOrientation setStepping getVisionSensorImg getObjectHandle "
    "readProximitySensor getStringSignal step unpackTable getSimulationTime getJointTargetVelocity "
    "setJointTargetPosition getJointPosition getObjectAlias getObjectsInTree handleVisionSensor setJointPosition "
    "getObjectQuaternion setObjectQuaternion getObjectVelocity setJointTargetForce addLog packTable setStringSignal",
    81: "loadScene closeScene",
    100: "setBoolProperty setArrayParam getArrayParam setBoolParam getBoolParam getInt32Param setInt32Param "
    "getFloatParam setFloatParam getStringParam getObjectInt32Param setObjectInt32Param getObjectFloatParam "
    "getModelProperty setModelProperty isDynamicallyEnabled",
    107: "setObjectParent setObjectAlias removeObject removeObjects removeModel createDummy loadModel setShapeColor "
    "getShapeColor resetDynamicObject createPrimitiveShape createPureShape",
    113: "getObjectMatrix setObjectMatrix multiplyVector multiplyMatrices buildMatrix getMatrixInverse getObjectPose "
    "setObjectPose",
    118: "callScriptFunction getScript getScriptFunctions",
    121: "setJointForce setJointMaxForce getJointForce",
}


def test_the_functions_of_public_programs_exist(sim: Any) -> None:
    known = sim.client.call("zmqRemoteApi.info", ["sim"])
    missing = {count: [name for name in names.split() if name not in known] for count, names in PUBLIC.items()}
    assert missing == {count: [] for count in PUBLIC}
