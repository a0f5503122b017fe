# SPDX-License-Identifier: BSD-3-Clause
"""The services of the package simulation_interfaces, called by a node of ROS 1."""

from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest

from node_support import Node, write
from ros_support import DEADLINE, RosCore, wait_until
from service_caller import ServiceCaller

OK, NOT_FOUND, FAILED, UNSUPPORTED = 1, 2, 4, 0
STOPPED, PLAYING, PAUSED, QUITTING = range(4)
SCENE = """\
<?xml version="1.0"?>
<sdf version="1.9">
  <world name="one">
    <gravity>0 0 0</gravity>
    <physics name="default" type="ode"><max_step_size>0.005</max_step_size></physics>
    <model name="Platform"><pose>1 2 0 0 0 1.5707963267948966</pose><link name="link"/></model>
    <model name="Wall"><static>true</static><link name="link"/></model>
  </world>
</sdf>
"""
BALL = """\
<sdf version="1.9">
  <model name="Ball">
    <link name="link">
      <inertial><mass>1</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>
      <collision name="ball"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
    </link>
  </model>
</sdf>
"""
IDENTITY = {"orientation": {"w": 1.0}}
Call = Callable[..., Any]


@pytest.fixture
def node(roscore: RosCore, tmp_path: Path) -> Iterator[Node]:
    scene = write(tmp_path / "scene.sdf", SCENE)
    with Node(roscore.env, tmp_path / "log", scene, "--paused") as running:
        running.wait_until_ready(roscore)
        yield running


@pytest.fixture
def call(node: Node, roscore: RosCore) -> Iterator[Call]:
    with ServiceCaller(roscore) as caller:
        yield caller


def state(call: Call) -> int:
    found: int = call("/get_simulation_state")["state"]["state"]
    return found


def code(response: Any) -> int:
    found: int = response["result"]["result"]
    return found


def names(call: Call) -> list[str]:
    found: list[str] = call("/get_entities")["entities"]
    return found


def spawn(call: Call, **request: Any) -> Any:
    return call("/spawn_entity", **{"resource_string": BALL, "initial_pose": {"pose": IDENTITY}, **request})


def time_of(call: Call) -> float:
    stamp = call("/get_entity_state", entity="Platform")["state"]["header"]["stamp"]
    return float(stamp["secs"] + 1e-9 * stamp["nsecs"])


def x_of(call: Call, name: str) -> float:
    return float(call("/get_entity_state", entity=name)["state"]["pose"]["position"]["x"])


def test_features_are_those_that_are_served(call: Call) -> None:
    features = call("/get_simulator_features")["features"]
    assert features["spawn_formats"] == ["sdf", "urdf"]
    assert {0, 1, 10, 11, 20, 24, 25, 31} <= set(features["features"])
    assert 33 not in features["features"]  # the action is of ROS 2


def test_the_state_follows_the_requests(node: Node, call: Call) -> None:
    assert state(call) == PAUSED
    assert code(call("/set_simulation_state", state={"state": PLAYING})) == OK
    wait_until(lambda: state(call) == PLAYING, "the simulation to play")
    assert code(call("/set_simulation_state", state={"state": PLAYING})) == 101
    assert code(call("/set_simulation_state", state={"state": STOPPED})) == OK
    wait_until(lambda: state(call) == STOPPED, "the simulation to stop")
    assert code(call("/set_simulation_state", state={"state": PAUSED})) == 103
    assert code(call("/set_simulation_state", state={"state": 9})) == UNSUPPORTED
    assert code(call("/set_simulation_state", state={"state": QUITTING})) == OK
    assert node.process.wait(timeout=DEADLINE) == 0


def test_steps_run_while_it_is_paused(call: Call) -> None:
    before = time_of(call)
    assert call("/step_simulation", steps=20)["result"] == {"result": OK, "error_message": ""}
    assert time_of(call) - before == pytest.approx(1.0)
    call("/set_simulation_state", state={"state": PLAYING})
    wait_until(lambda: state(call) == PLAYING, "the simulation to play")
    refused = call("/step_simulation", steps=1)
    assert code(refused) == FAILED
    assert "pause it first" in refused["result"]["error_message"]


def test_a_pause_ends_steps(call: Call, roscore: RosCore) -> None:
    with ThreadPoolExecutor() as pool, ServiceCaller(roscore) as other:
        answer = pool.submit(call, "/step_simulation", steps=100_000_000)
        wait_until(lambda: time_of(other) > 1.0, "some steps")
        other("/sim_ros_interface/pause")
        assert code(answer.result(timeout=DEADLINE)) == FAILED


def test_entities_are_models_by_name(call: Call) -> None:
    assert names(call) == ["Platform", "Wall"]
    assert call("/get_entities", filters={"filter": "^P"})["entities"] == ["Platform"]
    both = call("/get_entities_states")
    assert both["entities"] == ["Platform", "Wall"]
    assert both["states"][0]["pose"]["position"] == {"x": 1.0, "y": 2.0, "z": 0.0}
    assert code(call("/get_entities", filters={"filter": "("})) == FAILED
    assert code(call("/get_entities", filters={"tags": {"tags": ["a"]}})) == UNSUPPORTED
    missing = call("/get_entity_state", entity="Platfrom")
    assert (code(missing), "Platform" in missing["result"]["error_message"]) == (NOT_FOUND, True)


def test_states_are_set_in_a_frame(call: Call) -> None:
    at = {"pose": {"position": {"x": 2.0}, **IDENTITY}, "header": {"frame_id": "Platform"}}
    assert code(spawn(call)) == OK
    assert code(call("/set_entity_state", entity="Ball", state={**at, "twist": {"linear": {"x": 1.0}}})) == OK
    found = call("/get_entity_state", entity="Ball")["state"]  # Platform is turned by 90 degrees
    assert found["pose"]["position"] == pytest.approx({"x": 1.0, "y": 4.0, "z": 0.0})
    assert found["twist"]["linear"] == pytest.approx({"x": 0.0, "y": 1.0, "z": 0.0})
    moving = {"pose": IDENTITY, "twist": {"linear": {"x": 1.0}}}
    assert code(call("/set_entity_state", entity="Wall", state=moving)) == FAILED
    assert code(call("/set_entity_state", entity="Ball", state={})) == FAILED  # no quaternion


def test_models_are_spawned_and_deleted(call: Call, tmp_path: Path) -> None:
    file = write(tmp_path / "ball.sdf", BALL)
    pose = {"header": {"frame_id": "Platform"}, "pose": {"position": {"x": 1.0}, **IDENTITY}}
    assert spawn(call, resource_string="", uri=str(file), initial_pose=pose)["entity_name"] == "Ball"
    assert call("/get_entity_state", entity="Ball")["state"]["pose"]["position"]["y"] == pytest.approx(3.0)
    assert spawn(call, name="Other", uri=f"file://{file}")["entity_name"] == "Other"
    assert code(spawn(call)) == 101
    assert spawn(call, allow_renaming=True)["entity_name"] == "Ball_1"
    assert names(call) == ["Platform", "Wall", "Ball", "Other", "Ball_1"]
    assert code(call("/delete_entity", entity="Other")) == OK
    assert code(call("/delete_entity", entity="Other")) == NOT_FOUND
    assert names(call) == ["Platform", "Wall", "Ball", "Ball_1"]


@pytest.mark.parametrize(
    ("request_", "reported"),
    [
        ({"resource_string": ""}, 104),
        ({"uri": "/nowhere/ball.sdf"}, 104),
        ({"uri": "model://nothing"}, 104),
        ({"uri": "https://example.org/ball.sdf"}, 103),
        ({"uri": "/etc/passwd"}, 103),
        ({"resource_string": "<sdf version='1.9'><model name='Ball'/></sdf>"}, 106),
        ({"initial_pose": {}}, 109),
        ({"initial_pose": {"header": {"frame_id": "Nobody"}, "pose": IDENTITY}}, NOT_FOUND),
    ],
)
def test_what_cannot_be_spawned_changes_nothing(call: Call, request_: dict[str, Any], reported: int) -> None:
    response = spawn(call, **request_)
    assert code(response) == reported
    assert response["result"]["error_message"] != ""
    assert names(call) == ["Platform", "Wall"]


def test_a_reset_has_a_scope(call: Call) -> None:
    spawn(call)
    move = {"pose": {"position": {"x": 7.0}, **IDENTITY}}
    call("/set_entity_state", entity="Platform", state=move)
    call("/step_simulation", steps=2)
    assert code(call("/reset_simulation", scope=1)) == UNSUPPORTED
    assert code(call("/reset_simulation", scope=2)) == OK
    assert (x_of(call, "Platform"), "Ball" in names(call)) == (1.0, True)
    assert time_of(call) == pytest.approx(0.1)
    assert code(call("/reset_simulation", scope=4)) == OK
    assert names(call) == ["Platform", "Wall"]
    spawn(call)
    assert code(call("/reset_simulation")) == OK
    assert names(call) == ["Platform", "Wall"]
    assert time_of(call) == 0.0
