# SPDX-License-Identifier: BSD-3-Clause
"""Controllers of a robot with transmissions, through the services, topics and actions of ros_control."""

import itertools
import json
import math
import statistics
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from launch_support import with_packages
from node_support import Node, write
from ros_support import DEADLINE, REPOSITORY, SUPPORT, RosCore, wait_until
from service_caller import ServiceCaller

ARM = REPOSITORY / "scenes" / "models" / "arm"
WORLD = REPOSITORY / "compat" / "gazebo_ros" / "worlds" / "empty.world"
SUCCEEDED, PREEMPTED, ABORTED, REJECTED = 3, 2, 4, 5  # of actionlib_msgs/GoalStatus
INVALID_JOINTS = -2  # of control_msgs/FollowJointTrajectoryResult
STRICT, BEST_EFFORT = 2, 1


class Arm:
    """The arm in a running node."""

    def __init__(self, core: RosCore, call: ServiceCaller) -> None:
        self.core = core
        self.call = call

    def __call__(self, service: str, **request: Any) -> Any:
        return self.call(f"/controller_manager/{service}", **request)

    def load(self, *names: str) -> None:
        for name in names:
            assert self("load_controller", name=name)["ok"], name

    def switch(
        self, *, start: list[str] | None = None, stop: list[str] | None = None, strictness: int = STRICT
    ) -> bool:
        request = {"start_controllers": start or [], "stop_controllers": stop or [], "strictness": strictness}
        return bool(self("switch_controller", **request)["ok"])

    def states(self) -> dict[str, str]:
        return {each["name"]: each["state"] for each in self("list_controllers")["controller"]}

    def position(self, joint: str) -> float:
        return float(self.call("/gazebo/get_joint_properties", joint_name=f"arm::{joint}")["position"][0])

    def follow(self, controller: str, **goal: Any) -> dict[str, Any]:
        run = subprocess.run(
            ["/usr/bin/python3", str(SUPPORT / "follow_trajectory.py"), controller, json.dumps(goal)],
            env=self.core.env,
            capture_output=True,
            text=True,
            timeout=6 * DEADLINE,
            check=False,
        )
        assert run.returncode == 0, run.stderr
        result: dict[str, Any] = json.loads(run.stdout.splitlines()[-1])
        return result

    def publish(self, topic: str, kind: str, message: str) -> Any:
        return self.core.publishing(topic, kind, message)


def add_package_of_controllers(package: Path) -> None:
    """Write a package with the controller of the documentation, and one that fails."""
    page = (REPOSITORY / "docs" / "robots" / "controllers.md").read_text()
    code = page.split("```python\n", 1)[1].split("```", 1)[0]
    failing = "class Failing(Spring):\n    def publish(self):\n        raise RuntimeError('broken')\n"
    (package / "src" / "springs").mkdir(parents=True)
    write(package / "src" / "springs" / "__init__.py", "")
    write(package / "src" / "springs" / "spring.py", f"{code}\n\n{failing}")
    exports = "".join(
        f'<bubblesim controller="springs/{name}" class="springs.spring:{name}"/>'
        for name in ("Spring", "Failing", "Missing")
    )
    write(package / "package.xml", f"<package><name>springs</name><export>{exports}</export></package>")


@pytest.fixture(scope="module")
def node(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Arm]:
    folder = tmp_path_factory.mktemp("arm")
    add_package_of_controllers(folder / "packages" / "springs")
    with RosCore(folder / "roslog") as core:
        core.env.update(with_packages(core.env, folder / "packages"))
        core.run("rosparam", "load", str(ARM / "controllers.yaml"))
        core.run("rosparam", "set", "/use_sim_time", "true")
        with (
            Node(core.env, folder / "log", WORLD, "--gazebo-compat", "--speed", "3") as node,
            ServiceCaller(core) as call,
        ):
            wait_until(lambda: "/gazebo/link_states" in core.state()["publishers"], "the services")
            answer = call("/gazebo/spawn_urdf_model", model_name="arm", model_xml=(ARM / "arm.urdf").read_text(),
                          robot_namespace="/")  # fmt: skip
            assert answer["success"], answer
            wait_until(lambda: "/controller_manager/unload_controller" in core.state()["services"], "the manager")
            yield Arm(core, call)
            assert node.end() == 0


@pytest.fixture
def arm(node: Arm) -> Iterator[Arm]:
    yield node
    node("reload_controller_libraries", force_kill=True)
    assert node.states() == {}


def is_still(arm: Arm) -> bool:
    rates = [
        arm.call("/gazebo/get_joint_properties", joint_name=f"arm::{name}")["rate"][0] for name in ("shoulder", "elbow")
    ]
    return max(map(abs, rates)) < 1e-3


def test_controllers_go_from_loaded_to_running_to_stopped(arm: Arm) -> None:
    arm.load("joint_state_controller", "trajectory_controller")
    assert arm.states() == {"joint_state_controller": "initialized", "trajectory_controller": "initialized"}
    assert arm.switch(start=["joint_state_controller", "trajectory_controller"])
    assert set(arm.states().values()) == {"running"}
    assert not arm("unload_controller", name="trajectory_controller")["ok"], "it runs"
    assert arm.switch(stop=["trajectory_controller"])
    assert arm.states()["trajectory_controller"] == "stopped"
    assert arm("unload_controller", name="trajectory_controller")["ok"]
    assert arm.states() == {"joint_state_controller": "running"}


def test_the_joints_that_a_controller_claims_are_listed(arm: Arm) -> None:
    arm.load("trajectory_controller")
    (controller,) = arm("list_controllers")["controller"]
    assert controller["type"] == "position_controllers/JointTrajectoryController"
    assert controller["claimed_resources"] == [
        {"hardware_interface": "hardware_interface/PositionJointInterface", "resources": ["shoulder", "elbow"]}
    ]


def test_a_joint_has_one_controller_at_a_time(arm: Arm) -> None:
    arm.load("trajectory_controller", "shoulder_position_controller")
    assert arm.switch(start=["trajectory_controller"])
    assert not arm.switch(start=["shoulder_position_controller"])
    assert arm.states()["shoulder_position_controller"] == "initialized"
    assert arm.switch(start=["shoulder_position_controller"], stop=["trajectory_controller"])
    assert arm.states() == {"trajectory_controller": "stopped", "shoulder_position_controller": "running"}


def test_a_strict_switch_is_whole_or_nothing(arm: Arm) -> None:
    arm.load("joint_state_controller")
    assert not arm.switch(start=["joint_state_controller", "nonsense"])
    assert arm.states() == {"joint_state_controller": "initialized"}
    assert arm.switch(start=["joint_state_controller", "nonsense"], strictness=BEST_EFFORT)
    assert arm.states() == {"joint_state_controller": "running"}


def test_switches_back_and_forth_lose_nothing(arm: Arm) -> None:
    arm.load("trajectory_controller", "effort_trajectory_controller")
    assert arm.switch(start=["trajectory_controller"])
    wait_until(lambda: is_still(arm), "the arm to stand still")
    pair = ["trajectory_controller", "effort_trajectory_controller"]
    for _ in range(1000):
        pair.reverse()
        assert arm.switch(start=[pair[0]], stop=[pair[1]])
    assert sorted(arm.states().values()) == ["running", "stopped"]
    wait_until(lambda: is_still(arm), "the controller that runs to hold the arm")


def test_what_cannot_be_loaded_is_refused(arm: Arm) -> None:
    assert not arm("load_controller", name="no_such_controller")["ok"]
    arm.load("joint_state_controller")
    assert not arm("load_controller", name="joint_state_controller")["ok"], "it is loaded already"
    types = arm("list_controller_types")
    assert "diff_drive_controller/DiffDriveController" in types["types"]
    assert len(types["types"]) == len(types["base_classes"])


def test_a_trajectory_is_followed(arm: Arm) -> None:
    arm.load("joint_state_controller", "trajectory_controller")
    arm.switch(start=["joint_state_controller", "trajectory_controller"])
    points = [[1.0, [0.5, -0.8], [0.0, 0.0]], [2.0, [-0.2, 0.3], [0.0, 0.0]]]
    result = arm.follow("/trajectory_controller", names=["shoulder", "elbow"], points=points)
    assert (result["state"], result["error_code"]) == (SUCCEEDED, 0), result
    assert result["largest_error"] < 2e-3
    assert 1.9 < result["took"] < 5.0, "2 s, and the way of goal and result on a busy machine"
    assert result["positions"]["shoulder"] == pytest.approx(-0.2, abs=2e-3)
    assert result["positions"]["elbow"] == pytest.approx(0.3, abs=2e-3)


def test_a_trajectory_is_followed_by_efforts(arm: Arm) -> None:
    arm.load("joint_state_controller", "effort_trajectory_controller")
    arm.switch(start=["joint_state_controller", "effort_trajectory_controller"])
    points = [[2.0, [0.4, 0.6], [0.0, 0.0]]]
    result = arm.follow("/effort_trajectory_controller", names=["elbow", "shoulder"], points=points)
    assert (result["state"], result["error_code"]) == (SUCCEEDED, 0), result
    assert result["positions"]["shoulder"] == pytest.approx(0.6, abs=0.05)
    assert result["positions"]["elbow"] == pytest.approx(0.4, abs=0.05)


def test_a_cancelled_trajectory_stops_where_it_is(arm: Arm) -> None:
    arm.load("joint_state_controller", "trajectory_controller")
    arm.switch(start=["joint_state_controller", "trajectory_controller"])
    before = arm.position("shoulder")
    points = [[20.0, [before + 1.0, 0.0], None]]
    result = arm.follow("/trajectory_controller", names=["shoulder", "elbow"], points=points, cancel_after=2.0)
    assert result["state"] == PREEMPTED
    stopped = arm.position("shoulder")
    assert before < stopped < before + 0.6
    assert arm.position("shoulder") == pytest.approx(stopped, abs=1e-3)


def test_a_violated_path_aborts_the_goal(arm: Arm) -> None:
    arm.load("joint_state_controller", "trajectory_controller")
    arm.switch(start=["joint_state_controller", "trajectory_controller"])
    points = [[0.1, [arm.position("shoulder") + 1.5, 0.0], None]]  # 15 rad/s; the joint reaches 3
    result = arm.follow("/trajectory_controller", names=["shoulder", "elbow"], points=points)
    assert (result["state"], result["error_code"]) == (ABORTED, -4), result
    assert "shoulder" in result["error_string"]


def test_goals_for_other_joints_are_rejected(arm: Arm) -> None:
    arm.load("joint_state_controller", "trajectory_controller")
    arm.switch(start=["joint_state_controller", "trajectory_controller"])
    result = arm.follow("/trajectory_controller", names=["wrist"], points=[[1.0, [0.5], None]])
    assert (result["state"], result["error_code"]) == (REJECTED, INVALID_JOINTS), result
    assert "wrist" in result["error_string"]


@pytest.mark.parametrize(
    ("code", "goal"),
    [
        pytest.param(-1, {"points": []}, id="no-points"),
        pytest.param(-1, {"points": [[1.0, [0.5], None]]}, id="one-position-for-two-joints"),
        pytest.param(-1, {"points": [[1.0, [0.5, 0.5], None], [0.5, [0.5, 0.5], None]]}, id="times-that-decrease"),
        pytest.param(-3, {"points": [[1.0, [0.5, 0.5], None]], "stamp": 0.001}, id="a-time-that-is-over"),
    ],
)
def test_goals_that_cannot_be_followed_are_rejected_with_their_error(arm: Arm, code: int, goal: dict[str, Any]) -> None:
    arm.load("joint_state_controller", "trajectory_controller")
    arm.switch(start=["joint_state_controller", "trajectory_controller"])
    result = arm.follow("/trajectory_controller", names=["shoulder", "elbow"], **goal)
    assert (result["state"], result["error_code"]) == (REJECTED, code), result
    assert result["error_string"]


def test_a_goal_for_a_controller_that_does_not_run_is_rejected(arm: Arm) -> None:
    arm.load("joint_state_controller", "trajectory_controller")
    arm.switch(start=["joint_state_controller"])
    result = arm.follow("/trajectory_controller", names=["shoulder", "elbow"], points=[[1.0, [0.5, 0.5], None]])
    assert (result["state"], result["error_code"]) == (REJECTED, -1), result


def test_a_position_controller_holds_what_its_topic_has(arm: Arm) -> None:
    arm.load("shoulder_position_controller")
    arm.switch(start=["shoulder_position_controller"])
    with arm.publish("/shoulder_position_controller/command", "std_msgs/Float64", "data: 0.3"):
        wait_until(lambda: abs(arm.position("shoulder") - 0.3) < 0.02, "the position")
    state = arm.core.echo("/shoulder_position_controller/state")
    assert "set_point: 0.3\n" in state
    assert "p: 400.0\n" in state


def test_joint_states_come_at_their_rate(arm: Arm) -> None:
    arm.load("joint_state_controller")
    arm.switch(start=["joint_state_controller"])
    text = arm.core.echo("/joint_states", field="/header/stamp", count=20)
    seconds = [int(part) for part in text.replace("nsecs:", "").replace("secs:", "").split() if part.isdigit()]
    stamps = [whole + rest * 1e-9 for whole, rest in zip(seconds[::2], seconds[1::2], strict=True)]
    periods = [(b - a) / 0.01 for a, b in itertools.pairwise(stamps)]  # a message may be lost: the queue holds 10
    assert periods == pytest.approx([round(each) for each in periods], abs=1e-4)
    assert statistics.mode(round(each) for each in periods) == 1


def numbers_of(text: str, section: str) -> list[float]:
    """Return x, y and z below a key of a message as text."""
    lines = text.split(f"{section}:", 1)[1].splitlines()[1:4]
    return [float(line.split(":")[1]) for line in lines]


def test_sensor_controllers_publish_gravity_and_the_weight_of_the_forearm(arm: Arm) -> None:
    arm.load("trajectory_controller", "imu_controller", "wrench_controller")
    assert arm.switch(start=["trajectory_controller", "imu_controller", "wrench_controller"])
    wait_until(lambda: is_still(arm), "the arm to stand still")
    reading = arm.core.echo("/forearm_imu")
    assert math.hypot(*numbers_of(reading, "linear_acceleration")) == pytest.approx(9.8, abs=0.05)
    assert 'frame_id: "forearm"' in reading
    load = arm.core.echo("/elbow_wrench")
    assert math.hypot(*numbers_of(load, "force")) == pytest.approx(0.5 * 9.8, rel=0.02)
    claimed = {each["name"]: each["claimed_resources"] for each in arm("list_controllers")["controller"]}
    assert claimed["imu_controller"] == []


def load_spring(arm: Arm, kind: str) -> bool:
    parameters = f"{{type: springs/{kind}, joint: elbow, stiffness: 60, damping: 2}}"
    arm.core.run("rosparam", "set", "/spring", parameters)
    return bool(arm("load_controller", name="spring")["ok"])


def test_a_controller_of_a_package_of_the_user_commands_its_joint(arm: Arm) -> None:
    assert load_spring(arm, "Spring")
    arm.load("shoulder_position_controller")
    assert arm.switch(start=["spring", "shoulder_position_controller"])
    wait_until(lambda: is_still(arm), "the spring to come to rest")
    before = arm.position("elbow")
    with arm.publish("/spring/rest", "std_msgs/Float64", "data: 0.5"):
        wait_until(lambda: abs(arm.position("elbow") - before - 0.5) < 0.1, "the new rest of the spring")


def test_a_controller_of_the_user_that_fails_is_stopped(arm: Arm) -> None:
    assert load_spring(arm, "Failing")
    arm.load("shoulder_position_controller")
    assert arm.switch(start=["spring", "shoulder_position_controller"])
    wait_until(lambda: arm.states()["spring"] == "stopped", "its end")
    assert arm.states()["shoulder_position_controller"] == "running"


def test_a_controller_of_the_user_that_cannot_be_imported_is_refused(arm: Arm) -> None:
    assert not load_spring(arm, "Missing")
    assert not load_spring(arm, "NotExported")


CART = """<robot name="cart">
  <link name="world"/>
  <link name="rail"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <link name="cart"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <link name="pole"><inertial><origin xyz="0 0 -0.5"/><mass value="1"/>
    <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="mount" type="fixed"><origin xyz="0 3 3"/><parent link="world"/><child link="rail"/></joint>
  <joint name="slide" type="prismatic"><parent link="rail"/><child link="cart"/><axis xyz="1 0 0"/>
    <limit lower="-2" upper="2" velocity="2" effort="200"/></joint>
  <joint name="swing" type="continuous"><parent link="cart"/><child link="pole"/><axis xyz="0 1 0"/></joint>
  <ros2_control name="GazeboSystem" type="system">
    <hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>
    <joint name="slide"><command_interface name="position"/>
      <state_interface name="position"><param name="initial_value">-0.5</param></state_interface></joint>
    <joint name="swing"><state_interface name="position"/></joint>
  </ros2_control>
  <gazebo><plugin filename="libgz_ros2_control-system.so" name="gz_ros2_control::GazeboSimROS2ControlPlugin">
    <ros><namespace>/cart</namespace></ros><parameters>controllers.yaml</parameters>
  </plugin></gazebo>
</robot>"""


def test_joints_in_a_ros2_control_element_are_controlled_too(node: Arm) -> None:
    node.core.run(
        "rosparam", "set", "/cart/slider", "{type: position_controllers/JointPositionController, joint: slide}"
    )
    node.core.run("rosparam", "set", "/cart/states",
                  "{type: joint_state_controller/JointStateController, publish_rate: 50}")  # fmt: skip
    assert node.call("/gazebo/spawn_urdf_model", model_name="cart", model_xml=CART, robot_namespace="/cart")["success"]
    manager = "/cart/controller_manager"
    wait_until(lambda: f"{manager}/unload_controller" in node.core.state()["services"], "the manager")

    def position() -> float:
        return float(node.call("/gazebo/get_joint_properties", joint_name="cart::slide")["position"][0])

    assert position() == pytest.approx(-0.5, abs=1e-3)  # its initial value
    for name in ("slider", "states"):
        assert node.call(f"{manager}/load_controller", name=name)["ok"]
    assert node.call(f"{manager}/switch_controller", start_controllers=["slider", "states"], strictness=STRICT)["ok"]
    with node.publish("/cart/slider/command", "std_msgs/Float64", "data: 0.7"):
        wait_until(lambda: abs(position() - 0.7) < 1e-3, "the position")
    assert "name: \n  - slide\n  - swing\n" in node.core.echo("/cart/joint_states")
    assert node.call("/gazebo/delete_model", model_name="cart")["success"]
