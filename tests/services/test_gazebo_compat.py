# SPDX-License-Identifier: BSD-3-Clause
"""Gazebo's services and topics, used by other nodes."""

import math
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml

from node_support import NAME, Node, write
from ros_support import RosCore, start, wait_until
from service_caller import ServiceCaller

# The platform faces y.
SCENE = """\
<?xml version="1.0"?>
<sdf version="1.9">
  <world name="three">
    <gravity>0 0 0</gravity>
    <physics name="default" type="ode"><max_step_size>0.005</max_step_size></physics>
    <model name="Platform"><pose>1 2 0 0 0 1.5707963267948966</pose><link name="base"/></model>
    <model name="Arm">
      <pose>5 0 0 0 0 0</pose>
      <link name="base"/>
      <link name="tip"><pose>0 0 1 0 0 0</pose></link>
    </model>
    <model name="Rock"><static>true</static><link name="link"/></model>
    <model name="Wheel">
      <pose>-5 0 0 0 0 0</pose>
      <link name="rim"/>
      <joint name="axle" type="continuous"><parent>world</parent><child>rim</child><axis><xyz>0 0 1</xyz></axis></joint>
    </model>
  </world>
</sdf>
"""
SDF = "<sdf version='1.9'><model name='Any'><link name='link'/></model></sdf>"
URDF = """<robot name='any'><link name='body'><inertial><mass value='1'/>
<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link></robot>"""
ENDLESS = {"secs": -1}
AHEAD = {"position": {"x": 3.0}, "orientation": {"w": 1.0}}


class Gazebo:
    """A running node and its services in /gazebo."""

    def __init__(self, core: RosCore, caller: ServiceCaller) -> None:
        self.core = core
        self.own = caller

    def __call__(self, service: str, **request: Any) -> Any:
        return self.own(f"/gazebo/{service}", **request)

    def position(self, model: str, frame: str = "") -> list[float]:
        state = self("get_model_state", model_name=model, relative_entity_name=frame)
        assert state["success"], state["status_message"]
        return vector(state["pose"]["position"])


def vector(message: dict[str, float]) -> list[float]:
    return [message[axis] for axis in "xyz"]


def named(message: Any, name: str) -> tuple[list[float], list[float]]:
    """Return position and linear velocity of a named entry of a state message."""
    index = message["name"].index(name)
    return vector(message["pose"][index]["position"]), vector(message["twist"][index]["linear"])


@pytest.fixture(scope="module")
def gazebo(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Gazebo]:
    folder = tmp_path_factory.mktemp("gazebo")
    scene = write(folder / "three.sdf", SCENE)
    with (
        RosCore(folder / "roslog") as core,
        Node(core.env, folder / "log", scene, "--gazebo-compat", "--paused") as node,
        ServiceCaller(core) as caller,
    ):
        # Registered one after the other; this is the last one.
        wait_until(lambda: "/gazebo/link_states" in core.state()["publishers"], "services and topics")
        yield Gazebo(core, caller)
        assert node.end() == 0
        assert "error" not in node.output


@pytest.fixture(autouse=True)
def at_the_start(gazebo: Gazebo) -> None:
    gazebo("reset_simulation")


def test_the_world_returns_its_models_and_time(gazebo: Gazebo) -> None:
    answer = gazebo("get_world_properties")
    assert answer == {
        "sim_time": 0,
        "model_names": ["Platform", "Arm", "Rock", "Wheel"],
        "rendering_enabled": True,
        "success": True,
        "status_message": "GetWorldProperties: got properties",
    }


def test_states_are_relative_to_a_frame(gazebo: Gazebo) -> None:
    # From the platform: Arm is 4 m along x and -2 m along y of the world, so -2 ahead and 4 to the right.
    for frame in ("Platform", "Platform::base"):
        assert gazebo.position("Arm", frame) == pytest.approx([-2, -4, 0])
    for frame in ("", "world", "map", "/map"):
        assert gazebo.position("Arm", frame) == pytest.approx([5, 0, 0])
    answer = gazebo("get_link_state", link_name="Arm::tip", reference_frame="Arm::base")
    assert answer["success"]
    assert answer["link_state"]["link_name"] == "Arm::tip"
    assert vector(answer["link_state"]["pose"]["position"]) == pytest.approx([0, 0, 1])


def test_a_state_that_was_set_is_read_back(gazebo: Gazebo) -> None:
    turned = {"x": 0.0, "y": 0.0, "z": math.sin(0.5), "w": math.cos(0.5)}
    state = {
        "pose": {"position": {"x": 3.0, "y": 0.0, "z": 0.5}, "orientation": turned},
        "twist": {"linear": {"x": 1.0, "y": 2.0, "z": 0.0}, "angular": {"x": 0.0, "y": 0.0, "z": 0.3}},
    }
    turning = {"pose": {"position": {"x": 1.0, "y": 2.0}}, "twist": {"angular": {"z": 0.7}, "linear": {"x": 0.2}}}
    assert gazebo("set_model_state", model_state={"model_name": "Platform", **turning})["success"]
    for frame in ("", "Platform"):
        for service, kind, name in (("model", "model", "Arm"), ("link", "link", "Arm::tip")):
            request = {f"{kind}_name": name, "reference_frame": frame, **state}
            assert gazebo(f"set_{service}_state", **{f"{kind}_state": request})["success"]
            reference = "relative_entity_name" if kind == "model" else "reference_frame"
            answer = gazebo(f"get_{service}_state", **{f"{kind}_name": name, reference: frame})
            found = answer["link_state"] if kind == "link" else answer
            for part, values in (
                ("pose", "position"),
                ("pose", "orientation"),
                ("twist", "linear"),
                ("twist", "angular"),
            ):
                assert found[part][values] == pytest.approx(state[part][values]), (frame, kind, part, values)


def test_a_velocity_relative_to_a_frame_is_along_its_axes(gazebo: Gazebo) -> None:
    state = {"model_name": "Arm", "pose": AHEAD, "twist": {"linear": {"x": 2.0}}, "reference_frame": "Platform"}
    assert gazebo("set_model_state", model_state=state)["success"]
    assert gazebo.position("Arm") == pytest.approx([1, 5, 0])
    answer = gazebo("get_model_state", model_name="Arm")
    assert vector(answer["twist"]["linear"]) == pytest.approx([0, 2, 0])


@pytest.mark.parametrize(("service", "xml"), [("spawn_sdf_model", SDF), ("spawn_urdf_model", URDF)])
def test_models_come_and_go(gazebo: Gazebo, service: str, xml: str) -> None:
    request = {"model_name": "New", "model_xml": xml, "initial_pose": AHEAD, "reference_frame": "Platform::base"}
    answer = gazebo(service, **request)
    assert answer == {"success": True, "status_message": "SpawnModel: Successfully spawned entity"}
    assert gazebo.position("New") == pytest.approx([1, 5, 0])
    gazebo("reset_world")
    assert gazebo.position("New") == pytest.approx([1, 5, 0])
    assert gazebo(service, **request)["success"] is False  # the name is in use
    assert gazebo("delete_model", model_name="New")["success"]
    assert "New" not in gazebo("get_world_properties")["model_names"]


def test_an_orientation_of_zeros_is_none(gazebo: Gazebo) -> None:
    assert gazebo("set_model_state", model_state={"model_name": "Arm"})["success"]
    assert gazebo("get_model_state", model_name="Arm")["pose"]["orientation"] == {"x": 0, "y": 0, "z": 0, "w": 1}


BAD_REQUESTS: list[tuple[str, dict[str, Any], str]] = [
    ("get_model_state", {"model_name": "Amr"}, "/Arm"),
    ("get_model_state", {"model_name": ""}, "no object"),
    ("get_model_state", {"model_name": "Arm::tip"}, "is a link, not a model"),
    ("get_model_state", {"model_name": "Arm", "relative_entity_name": "Platfrom"}, "/Platform"),
    ("get_link_state", {"link_name": "Arm"}, "is a model, not a link"),
    ("get_link_state", {"link_name": "Arm::tipp"}, "/Arm/tip"),
    ("set_model_state", {"model_state": {"model_name": "Rock"}}, "is static"),
    ("set_model_state", {"model_state": {"model_name": "Arm", "pose": {"position": {"x": math.nan}}}}, "finite"),
    ("set_model_state", {"model_state": {"model_name": "Arm", "pose": {"position": {"x": 1e300}}}}, "1e+300"),
    ("set_model_state", {"model_state": {"model_name": "Arm", "pose": {"orientation": {"w": math.nan}}}}, "quaternion"),
    ("set_model_state", {"model_state": {"model_name": "Arm", "twist": {"linear": {"x": math.inf}}}}, "velocity"),
    ("set_link_state", {"link_state": {"link_name": "Arm::tip", "twist": {"angular": {"x": 1e300}}}}, "velocity"),
    ("set_link_state", {"link_state": {"link_name": "Arm::tip", "reference_frame": "x"}}, "no object"),
    ("delete_model", {"model_name": "Arm::tip"}, "is a link, not a model"),
    ("delete_model", {"model_name": "Nothing"}, "no object"),
    ("spawn_sdf_model", {"model_name": "New", "model_xml": ""}, "model_xml is empty: it must be the text"),
    ("spawn_sdf_model", {"model_name": "New", "model_xml": "<sdf"}, "is not well-formed XML"),
    ("spawn_sdf_model", {"model_name": "New", "model_xml": SDF, "reference_frame": "x"}, "no object"),
    ("spawn_urdf_model", {"model_name": "New", "model_xml": URDF.replace("'1'/>", "'-1'/>")}, ""),
    ("apply_body_wrench", {"body_name": "Arm"}, "is a model, not a link"),
    ("apply_body_wrench", {"body_name": "Rock::link", "wrench": {"force": {"x": 1.0}}}, "is static"),
    ("apply_body_wrench", {"body_name": "Arm::tip", "wrench": {"torque": {"x": math.inf}}}, "finite"),
    ("apply_body_wrench", {"body_name": "Arm::tip", "reference_frame": "x"}, "no object"),
    ("apply_joint_effort", {"joint_name": "axel"}, "/axle"),
    ("apply_joint_effort", {"joint_name": "axle", "effort": math.nan}, "finite"),
    ("apply_joint_effort", {"joint_name": "Wheel"}, "is a model, not a joint"),
]


def test_bad_requests_are_refused_with_a_reason_and_change_nothing(gazebo: Gazebo) -> None:
    before = gazebo("get_link_state", link_name="Arm::tip")
    for service, request, reason in BAD_REQUESTS:
        answer = gazebo(service, **request)
        assert answer["success"] is False, (service, request)
        assert reason in answer["status_message"], (service, request)
    assert gazebo("get_link_state", link_name="Arm::tip") == before
    assert gazebo("get_world_properties")["model_names"] == ["Platform", "Arm", "Rock", "Wheel"]


def test_time_is_stopped_and_started(gazebo: Gazebo) -> None:
    def time() -> float:
        return float(gazebo("get_world_properties")["sim_time"])

    gazebo("unpause_physics")
    wait_until(lambda: time() > 0.2, "time to go on")
    gazebo("pause_physics")
    wait_until(lambda: time() == time(), "time to stand still")
    gazebo("reset_world")
    assert time() > 0
    gazebo("reset_simulation")
    assert time() == 0


def steps(gazebo: Gazebo, count: int) -> None:
    assert gazebo.own(f"{NAME}/step", steps=count)["success"]


def ros_time(seconds: float) -> dict[str, int]:
    whole = math.floor(seconds)
    return {"secs": whole, "nsecs": round((seconds - whole) * 1e9)}


def link_velocity(gazebo: Gazebo, link: str) -> tuple[list[float], list[float]]:
    twist = gazebo("get_link_state", link_name=link)["link_state"]["twist"]
    return vector(twist["linear"]), vector(twist["angular"])


def test_a_wrench_acts_exactly_as_long_as_it_should(gazebo: Gazebo) -> None:
    # Neither start nor end are those of a step; the link has 1 kg.
    wrench = {"force": {"x": 2.0}, "torque": {"z": 1.0}}
    times = {"start_time": ros_time(0.12), "duration": ros_time(0.1234)}
    assert gazebo("apply_body_wrench", body_name="Platform::base", wrench=wrench, **times)["success"]
    steps(gazebo, 2)
    assert link_velocity(gazebo, "Platform::base") == ([0, 0, 0], [0, 0, 0])
    steps(gazebo, 8)
    linear, angular = link_velocity(gazebo, "Platform::base")
    assert linear == pytest.approx([2 * 0.1234, 0, 0], abs=1e-9)
    assert angular == pytest.approx([0, 0, 0.1234], abs=1e-9)


def test_a_wrench_has_the_axes_and_the_point_of_its_frame(gazebo: Gazebo) -> None:
    request = {"reference_frame": "Platform", "reference_point": {"y": 0.5}, "wrench": {"force": {"x": 2.0}}}
    assert gazebo("apply_body_wrench", body_name="Platform::base", **request, duration=ros_time(0.005))["success"]
    steps(gazebo, 1)
    linear, angular = link_velocity(gazebo, "Platform::base")
    assert linear == pytest.approx([0, 0.01, 0], abs=1e-9)  # the platform faces y
    assert angular == pytest.approx([0, 0, -0.005], abs=1e-9)


def test_a_wrench_without_end_ends_when_it_is_cleared(gazebo: Gazebo) -> None:
    assert gazebo("apply_body_wrench", body_name="Arm::tip", wrench={"force": {"y": 1.0}}, duration=ENDLESS)["success"]
    steps(gazebo, 20)
    gazebo("clear_body_wrenches", body_name="Arm::tip")
    steps(gazebo, 5)
    assert link_velocity(gazebo, "Arm::tip")[0] == pytest.approx([0, 1, 0], abs=1e-9)


def test_an_effort_turns_a_joint_for_its_time(gazebo: Gazebo) -> None:
    assert gazebo("apply_joint_effort", joint_name="axle", effort=0.5, duration=ros_time(0.123))["success"]
    steps(gazebo, 5)
    assert link_velocity(gazebo, "Wheel::rim")[1] == pytest.approx([0, 0, 0.5 * 0.123], abs=1e-6)
    assert gazebo("apply_joint_effort", joint_name="axle", effort=-0.5, duration=ENDLESS)["success"]
    steps(gazebo, 2)
    gazebo("clear_joint_forces", joint_name="axle")
    steps(gazebo, 2)
    assert link_velocity(gazebo, "Wheel::rim")[1] == pytest.approx([0, 0, 0.5 * 0.023], abs=1e-6)


def test_forces_end_with_a_reset(gazebo: Gazebo) -> None:
    assert gazebo("apply_body_wrench", body_name="Arm::tip", wrench={"force": {"y": 1.0}}, duration=ENDLESS)["success"]
    gazebo("reset_world")
    steps(gazebo, 2)
    assert link_velocity(gazebo, "Arm::tip")[0] == [0, 0, 0]


def test_topics_have_the_poses_of_all_objects(gazebo: Gazebo) -> None:
    state = {"model_name": "Arm", "pose": {"position": {"x": 7.0}}, "twist": {"angular": {"y": 0.5}}}
    assert gazebo("set_model_state", model_state=state)["success"]
    topics: dict[str, Any] = {}
    listeners = {
        topic: start(["rostopic", "echo", "-n", "1", f"/gazebo/{topic}"], gazebo.core.env, stdout=subprocess.PIPE)
        for topic in ("model_states", "link_states")
    }
    wait_until(
        lambda: all(f"/gazebo/{topic}" in gazebo.core.state()["subscribers"] for topic in listeners), "listeners"
    )

    def reported() -> bool:
        gazebo.own(f"{NAME}/step", steps=1)
        return all(listener.poll() is not None for listener in listeners.values())

    wait_until(reported, "both topics")
    for topic, listener in listeners.items():
        topics[topic] = next(yaml.safe_load_all(listener.communicate()[0]))
    assert topics["model_states"]["name"] == ["Platform", "Arm", "Rock", "Wheel"]
    assert topics["link_states"]["name"] == [*("Platform::base", "Arm::base", "Arm::tip", "Rock::link", "Wheel::rim")]
    assert named(topics["model_states"], "Platform")[0] == pytest.approx([1, 2, 0])
    # The tip moves round the base: v = w x r = (0, 0.5, 0) x (0, 0, 1).
    assert named(topics["link_states"], "Arm::tip")[1] == pytest.approx([0.5, 0, 0], abs=0.01)


def test_without_the_option_there_is_nothing_of_gazebo(roscore: RosCore, tmp_path: Path) -> None:
    script = write(tmp_path / "script.py", "def sysCall_init(): simROS.advertise('/last', 'std_msgs/Empty')\n")
    with Node(roscore.env, tmp_path / "log", "ball", "--child-script", f"/Ball={script}"):
        # Registered one after the other; what a script advertises comes after all services and topics of the node.
        wait_until(lambda: "/last" in roscore.state()["publishers"], "services and topics")
        names = [name for book in roscore.state().values() for name in book]
        assert not [name for name in names if name.startswith("/gazebo")]
