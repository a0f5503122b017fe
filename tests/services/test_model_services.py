# SPDX-License-Identifier: BSD-3-Clause
"""The services that add and remove models, called by other nodes."""

import math
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from node_support import NAME, Node, write
from ros_support import RosCore, wait_until
from service_caller import ServiceCaller

SCENE = """\
<?xml version="1.0"?>
<sdf version="1.9">
  <world name="one">
    <gravity>0 0 0</gravity>
    <physics name="default" type="ode"><max_step_size>0.005</max_step_size></physics>
    <model name="Platform"><pose>1 2 0 0 0 1.5707963267948966</pose><link name="link"/></model>
  </world>
</sdf>
"""
BALL = """\
<sdf version="1.9" xmlns:bubblesim="https://bubblesim">
  <model name="Ball">
    <link name="link">
      <inertial><mass>1</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>
      <collision name="ball"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
    </link>
  </model>
</sdf>
"""
SCRIPT = """\
import sys
def sysCall_init():
    print('hello from', sim.getObjectAlias(sim.getObject('.'), 2))
    self.topic = simROS.advertise('/of_the_model', 'std_msgs/Empty')
def sysCall_actuation(): pass
def sysCall_cleanup(): print('goodbye at', sim.getObjectPosition(sim.getObject('.'))[0])
"""
AHEAD = {"position": {"x": 3.0}, "orientation": {"w": 1.0}}


class Simulator:
    """A running node and its services."""

    def __init__(self, core: RosCore, node: Node, caller: ServiceCaller) -> None:
        self.core = core
        self.node = node
        self._caller = caller

    def call(self, service: str, **request: Any) -> Any:
        return self._caller(f"{NAME}/{service}", **request)

    def x_of(self, name: str) -> float | None:
        state = self.call("get_object_state", object=name)
        return None if "error" in state else float(state["pose"]["position"]["x"])


@pytest.fixture(scope="module")
def simulator(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Simulator]:
    folder = tmp_path_factory.mktemp("models")
    write(folder / "greet.py", SCRIPT)
    scene = write(folder / "one.sdf", SCENE)
    with (
        RosCore(folder / "roslog") as core,
        Node(core.env, folder / "log", scene) as node,
        ServiceCaller(core) as caller,
    ):
        wait_until(lambda: f"{NAME}/delete_object" in core.state()["services"], "the services")
        yield Simulator(core, node, caller)
        assert node.end() == 0
        assert "is disabled" not in node.output


def test_a_model_is_added_and_removed(simulator: Simulator) -> None:
    assert simulator.call("spawn_sdf", sdf=BALL, pose=AHEAD) == {"success": True, "status_message": ""}
    assert simulator.x_of("/Ball") == pytest.approx(3)
    assert simulator.call("delete_object", object="/Ball") == {"success": True, "status_message": ""}
    assert simulator.x_of("/Ball") is None


def test_name_and_reference_may_be_given(simulator: Simulator) -> None:
    # The platform faces y: a point 3 m ahead of it is at x = 1, y = 5.
    assert simulator.call("spawn_sdf", sdf=BALL, name="Other", pose=AHEAD, reference="/Platform")["success"]
    assert simulator.x_of("/Other") == pytest.approx(1)
    assert simulator.call("delete_object", object="/Other")["success"]


def test_the_script_of_a_model_comes_and_goes_with_it(simulator: Simulator) -> None:
    with_script = BALL.replace("<link", "<bubblesim:child_script>greet.py</bubblesim:child_script><link", 1)
    for name in ("First", "Second"):
        assert simulator.call("spawn_sdf", sdf=with_script, name=name, pose=AHEAD)["success"]
        simulator.node.wait_for_output(f"hello from /{name}")
        wait_until(lambda: "/of_the_model" in simulator.core.state()["publishers"], "the script's topic")
        assert simulator.call("delete_object", object=name)["success"]
        wait_until(lambda: "/of_the_model" not in simulator.core.state()["publishers"], "the topic to be gone")
    assert len(re.findall(r"^goodbye at 3\.0", simulator.node.output, re.MULTILINE)) == 2


BAD_REQUESTS: list[tuple[dict[str, Any], str]] = [
    ({"sdf": ""}, "is empty"),
    ({"sdf": "no XML"}, "contains no XML element"),
    ({"sdf": BALL.replace("</link>", "")}, "<data-string>:3: is not well-formed XML"),
    ({"sdf": "<robot name='r'/>"}, "contains no <link> except the world"),
    ({"sdf": BALL.replace("<mass>1", "<mass>0")}, "/Ball/link: the mass is 0 kg"),
    ({"sdf": BALL.replace("<mass>1", "<mass>1e300")}, "/Ball/link: the mass is 1e+300 kg"),
    ({"sdf": BALL.replace("<ixx>0.1", "<ixx>1e300")}, "inertia"),
    ({"sdf": BALL.replace("<radius>0.1", "<radius>-1")}, "radius"),
    ({"sdf": BALL.replace("<radius>0.1", "<radius>x")}, "<radius> has the invalid value 'x'"),
    ({"sdf": BALL.replace('name="Ball"', 'name=""')}, "name"),
    ({"name": "Platform"}, "/Platform: a model with this name exists already"),
    ({"name": "a/b"}, "the name contains '/'"),
    ({"pose": {"position": {"x": math.nan}, "orientation": {"w": 1.0}}}, "the position is (nan, 0, 0)"),
    ({"pose": {"position": {"x": 1e300}, "orientation": {"w": 1.0}}}, "the position is (1e+300, 0, 0)"),
    ({"pose": {"position": {"x": 1.0}}}, "the orientation"),
    ({"reference": "/Platfrom"}, "/Platform"),
]


@pytest.mark.parametrize(("change", "message"), BAD_REQUESTS)
def test_a_bad_model_is_refused_with_a_reason(simulator: Simulator, change: dict[str, Any], message: str) -> None:
    answer = simulator.call("spawn_sdf", **{"sdf": BALL, "pose": AHEAD, **change})
    assert answer["success"] is False
    assert message in answer["status_message"]
    assert simulator.x_of("/Ball") is None


def test_what_cannot_be_removed_stays(simulator: Simulator) -> None:
    reasons = {"/Platfrom": "/Platform", "/Platform/link": "cannot be removed on its own", "": "no object"}
    for path, message in reasons.items():
        answer = simulator.call("delete_object", object=path)
        assert answer["success"] is False
        assert message in answer["status_message"]
    assert simulator.x_of("/Platform") == pytest.approx(1)


def test_a_script_cannot_remove_its_own_model(simulator: Simulator, tmp_path: Path) -> None:
    script = write(
        tmp_path / "own.py",
        f"""\
        def sysCall_init():
            self.client = simROS.serviceClient('{NAME}/delete_object', 'bubblesim_msgs/DeleteObject')
            self.subscriber = simROS.subscribe('/tick', 'std_msgs/Empty', 'on_tick')
            self.publisher = simROS.advertise('/tick', 'std_msgs/Empty')
        def sysCall_actuation():
            simROS.publish(self.publisher, {{}})
        def on_tick(message):
            answer = simROS.call(self.client, {{'object': '/Own'}})
            print('reported:', answer['status_message'])
        """,
    )
    own = BALL.replace("<link", f"<bubblesim:child_script>{script}</bubblesim:child_script><link", 1)
    assert simulator.call("spawn_sdf", sdf=own, name="Own", pose=AHEAD)["success"]
    simulator.node.wait_for_output("reported: a child script cannot remove its own model")
    assert simulator.call("delete_object", object="/Own")["success"]
