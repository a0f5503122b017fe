# SPDX-License-Identifier: BSD-3-Clause
"""Controllers of a robot with transmissions, through the services, topics and actions of ros_control."""

import itertools
import json
import subprocess
from collections.abc import Iterator
from typing import Any

import pytest

from node_support import Node
from ros_support import DEADLINE, REPOSITORY, SUPPORT, RosCore, wait_until
from service_caller import ServiceCaller

ARM = REPOSITORY / "scenes" / "models" / "arm"
WORLD = REPOSITORY / "compat" / "gazebo_ros" / "worlds" / "empty.world"
SUCCEEDED, PREEMPTED, ABORTED, REJECTED = 3, 2, 4, 5  # of actionlib_msgs/GoalStatus
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


@pytest.fixture(scope="module")
def node(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Arm]:
    folder = tmp_path_factory.mktemp("arm")
    with RosCore(folder / "roslog") as core:
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
    for _ in range(200):
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
    assert result["took"] == pytest.approx(2.0, abs=0.3)
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
    assert result["state"] == REJECTED


def test_a_position_controller_holds_what_its_topic_has(arm: Arm) -> None:
    arm.load("shoulder_position_controller")
    arm.switch(start=["shoulder_position_controller"])
    with arm.publish("/shoulder_position_controller/command", "std_msgs/Float64", "data: 0.3"):
        wait_until(lambda: abs(arm.position("shoulder") - 0.3) < 0.02, "the position")
    state = arm.core.run("rostopic", "echo", "-n", "1", "/shoulder_position_controller/state")
    assert "set_point: 0.3\n" in state
    assert "p: 400.0\n" in state


def test_joint_states_come_at_their_rate(arm: Arm) -> None:
    arm.load("joint_state_controller")
    arm.switch(start=["joint_state_controller"])
    text = arm.core.run("rostopic", "echo", "-n", "20", "/joint_states/header/stamp")
    seconds = [int(part) for part in text.replace("nsecs:", "").replace("secs:", "").split() if part.isdigit()]
    stamps = [whole + rest * 1e-9 for whole, rest in zip(seconds[::2], seconds[1::2], strict=True)]
    assert [b - a for a, b in itertools.pairwise(stamps)] == pytest.approx([0.01] * 19, abs=1e-6)
