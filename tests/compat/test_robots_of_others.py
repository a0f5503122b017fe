# SPDX-License-Identifier: BSD-3-Clause
"""Robots that others have published, started by their own launch files: their topics, and how they move."""

import json
import subprocess
from pathlib import Path
from typing import Any

import pytest

from launch_support import ROBOTS, launched, with_packages
from process_support import cpu_seconds
from robots_of_others import NOT_MOUNTED, add_packages
from ros_support import DEADLINE, SUPPORT, RosCore, wait_until
from service_caller import ServiceCaller

pytestmark = pytest.mark.skipif(ROBOTS is None, reason="the robots of others are not there")

SPEED = {"BUBBLESIM_GAZEBO_OPTIONS": "--speed 3 --seed 1"}


def environment(core: RosCore, folder: Path, **more: str) -> dict[str, str]:
    assert ROBOTS is not None
    add_packages(folder, NOT_MOUNTED)
    return with_packages(core.env, ROBOTS, folder, **SPEED, **more)


def check_topics(env: dict[str, str], *nodes: str, expected: list[str]) -> None:
    """Check the values on all topics of nodes, among which are the expected ones."""
    checked = result_of(env, "check_topics.py", *nodes)
    assert set(expected) <= set(checked["topics"]), checked["topics"]
    assert not checked["problems"], json.dumps(checked["problems"], indent=1)


class Cost:
    """The processor time of the simulator in an interval of simulated time."""

    most = 4.0
    """s a second of simulated time: only --long holds more, on an idle machine."""

    def __init__(self, core: RosCore) -> None:
        self._pid = core.pid_of("/gazebo")
        self._before = cpu_seconds(self._pid)

    def check(self, simulated: float) -> None:
        """Assert that one core simulates fast enough."""
        share = (cpu_seconds(self._pid) - self._before) / simulated
        assert share < self.most, f"{share:.2f} s of processor time a second"


@pytest.fixture(autouse=True)
def _three_times_as_fast_as_real_time(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Hold with --long: a slow core that other programs keep busy needs several times the time for the same work."""
    if request.config.getoption("--long"):
        monkeypatch.setattr(Cost, "most", 1 / 3)


def result_of(env: dict[str, str], program: str, *arguments: object) -> dict[str, Any]:
    """Return the JSON that a program of the tests prints."""
    run = subprocess.run(
        ["/usr/bin/python3", str(SUPPORT / program), *map(str, arguments)],
        env=env,
        capture_output=True,
        text=True,
        timeout=6 * DEADLINE,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    result: dict[str, Any] = json.loads(run.stdout.splitlines()[-1])
    return result


@pytest.mark.parametrize(
    ("launch", "model", "commands", "odometry", "speeds", "topics"),
    [
        pytest.param(
            ["turtlebot3_gazebo", "turtlebot3_empty_world.launch"],
            "turtlebot3_burger",
            "/cmd_vel",
            "/odom",
            (0.2, 0.8),
            ["/imu", "/scan", "/joint_states", "/odom", "/tf"],
            id="turtlebot3",
        ),
        pytest.param(
            ["jackal_gazebo", "empty_world.launch", "config:=front_laser", "joystick:=false", "gui:=false"],
            "jackal",
            "/cmd_vel",
            "/odometry/filtered",
            (0.5, 0.8),
            ["/imu/data", "/front/scan", "/joint_states", "/jackal_velocity_controller/odom", "/navsat/fix", "/tf"],
            id="jackal",
        ),
        pytest.param(
            ["husky_gazebo", "empty_world.launch"],
            "husky",
            "/cmd_vel",
            "/odometry/filtered",
            (0.5, 0.4),
            ["/imu/data", "/joint_states", "/husky_velocity_controller/odom", "/navsat/fix", "/tf"],
            id="husky",
        ),
    ],
)
def test_mobile_robots_drive_and_turn_as_their_odometry_reports(
    tmp_path: Path,
    launch: list[str],
    model: str,
    commands: str,
    odometry: str,
    speeds: tuple[float, float],
    topics: list[str],
) -> None:
    with RosCore(tmp_path / "roslog") as core:
        env = environment(core, tmp_path / "packages", TURTLEBOT3_MODEL="burger")
        with (
            launched(core, env, tmp_path / "log", *launch, ready="/gazebo/link_states"),
            ServiceCaller(core) as call,
        ):
            wait_until(lambda: model in call("/gazebo/get_world_properties")["model_names"], "the robot", 3 * DEADLINE)
            wait_until(lambda: odometry in core.state()["publishers"], "its odometry", 3 * DEADLINE)
            check_topics(env, "/gazebo", "/ekf_localization", expected=topics)
            cost = Cost(core)
            moved = result_of(env, "drive_robot.py", model, commands, odometry, *speeds)
            cost.check(moved["took"])
        for quantity in ("distances", "angles"):
            reported, true = moved[quantity]
            assert reported == pytest.approx(true, rel=0.03), moved
        assert moved["distances"][1] >= 1.9


def running(call: ServiceCaller, namespace: str, *controllers: str) -> bool:
    listed = call(f"{namespace}/controller_manager/list_controllers").get("controller", [])
    return set(controllers) <= {each["name"] for each in listed if each["state"] == "running"}


def test_an_arm_moves_through_a_trajectory(tmp_path: Path) -> None:
    with RosCore(tmp_path / "roslog") as core:
        env = environment(core, tmp_path / "packages")
        launch = ["ur_gazebo", "ur5_bringup.launch", "gui:=false"]
        ready = "/controller_manager/load_controller"
        with launched(core, env, tmp_path / "log", *launch, ready=ready), ServiceCaller(core) as call:
            wait_until(lambda: running(call, "", "eff_joint_traj_controller"), "the controller", 3 * DEADLINE)
            names = ["shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3"]
            goal = [0.5, -1.2, 1.0, -0.5, 0.4, 0.3]
            points = [[2.0, [0.0, -1.57, 0.0, -1.57, 0.0, 0.0], [0.0] * 6], [4.0, goal, [0.0] * 6]]
            joints = [f"{name}_joint" for name in names]
            cost = Cost(core)
            goal_of_arm = json.dumps({"names": joints, "points": points})
            result = result_of(env, "follow_trajectory.py", "/eff_joint_traj_controller", goal_of_arm)
            cost.check(result["took"])
            check_topics(env, "/gazebo", "/robot_state_publisher", expected=["/joint_states", "/tf"])
            assert (result["state"], result["error_code"]) == (3, 0), result
            assert result["largest_error"] < 0.05, "half the tolerance of its controllers"
            assert [result["positions"][name] for name in joints] == pytest.approx(goal, abs=0.1)


def test_a_pendulum_is_held_by_its_position_controllers(tmp_path: Path) -> None:
    with RosCore(tmp_path / "roslog") as core:
        env = environment(core, tmp_path / "packages")
        world = ["rrbot_gazebo", "rrbot_world.launch", "gui:=false"]
        control = ["rrbot_control", "rrbot_control.launch"]
        with (
            launched(core, env, tmp_path / "log", *world, ready="/rrbot/controller_manager/load_controller"),
            launched(core, env, tmp_path / "log2", *control, ready="/rrbot/joint1_position_controller/state"),
            ServiceCaller(core) as call,
        ):
            wait_until(lambda: running(call, "/rrbot", "joint1_position_controller"), "the controllers", 3 * DEADLINE)
            check_topics(
                env,
                "/gazebo",
                expected=["/rrbot/laser/scan", "/rrbot/joint_states", "/rrbot/camera1/image_raw"],
            )
            cost, begin = Cost(core), simulated(call)
            wait_until(lambda: simulated(call) > begin + 3.0, "three seconds", 2 * DEADLINE)
            cost.check(simulated(call) - begin)
            command = "/rrbot/joint1_position_controller/command"
            with core.publishing(command, "std_msgs/Float64", "data: 0.8"):
                # The gain of 100 N m/rad bears the weight, at most 15.2 N m for what the second joint may hold, its
                # position when its controller started, with an error of up to 0.152 rad.
                wait_until(lambda: abs(rrbot_error(core)) < 0.16, "the position", 2 * DEADLINE)


def simulated(call: ServiceCaller) -> float:
    """Return the time of the simulation, s."""
    return float(call("/gazebo/get_world_properties")["sim_time"])


def rrbot_error(core: RosCore) -> float:
    text = core.echo("/rrbot/joint1_position_controller/state")
    (line,) = (line for line in text.splitlines() if line.startswith("error:"))
    (goal,) = (line for line in text.splitlines() if line.startswith("set_point:"))
    return float(line.split()[1]) if goal.split()[1] == "0.8" else 1.0
