# SPDX-License-Identifier: BSD-3-Clause
"""The fixtures with which users test their controllers on ROS 2, with nodes of rclpy."""

import os
from pathlib import Path

import pytest

from bubblesim.running.isolation import reserve_domain
from bubblesim.running.processes import RunError
from bubblesim.testing import any_simulator
from bubblesim.testing.mcap_messages import read_messages
from bubblesim.testing.plugin import StartController, StartRos2Simulator
from bubblesim.testing.ros2_domain import Ros2Domain, without_ros1
from cli_support import bubblesim
from node_support import write
from ros2_peer import PEERS, has_ros2

pytestmark = has_ros2
TOPICS = ["/speed", "/steering"]
CONTROLLER = """\
    import os
    import rclpy
    from rclpy.node import Node
    from std_msgs.msg import Float32

    rclpy.init()
    node = Node("mine")
    speed = node.create_publisher(Float32, "/speed", 10)
    steering = node.create_publisher(Float32, "/steering", 10)
    answers = 0

    def answer(message):
        global answers
        answers += 1
        if answers > {most}:
            {then}
        steering.publish(Float32(data=0.0))
        speed.publish(Float32(data=2.0))

    node.create_subscription(Float32, "/front_sonar", answer, 10)
    rclpy.spin(node)
"""


def command(folder: Path, most: int = 10_000, then: str = "return") -> str:
    """Write a controller that answers so many times; return how it is started."""
    if not (PEERS / "bin" / "python").exists():
        pytest.skip("rclpy is not installed: scripts/setup --with ros2 --with tests")
    code = write(folder / "mine.py", CONTROLLER.format(most=most, then=then))
    return f"{PEERS / 'bin' / 'python'} {code} --ros-args -p use_sim_time:=true"


def test_the_controller_drives_and_its_messages_are_known(
    tmp_path: Path, ros2_controller: StartController, ros2_sim: StartRos2Simulator
) -> None:
    ros2_controller(command(tmp_path))
    tricycle = ros2_sim("tricycle", lockstep=TOPICS)
    start = tricycle.position("/Tricycle")
    tricycle.run(3.0)
    assert tricycle.time == pytest.approx(3.0)
    assert tricycle.position("/Tricycle")[0] > start[0] + 0.1
    assert tricycle.orientation("/Tricycle")[3] == pytest.approx(1.0, abs=0.1)
    with pytest.raises(LookupError, match="did you mean /Tricycle"):
        tricycle.position("/Tricycl")
    speeds = tricycle.messages("/speed")
    assert {message.data for _, message in speeds} == {2.0}
    assert len(speeds) == 58  # 60 steps; the first has no subscriber yet, the last no answer yet
    assert speeds[1][0] - speeds[0][0] == pytest.approx(0.05)
    (_, transforms), *_ = tricycle.messages("/tf")
    assert transforms.transforms[0].header.frame_id == "odom"


def test_equal_runs_give_equal_bags(
    tmp_path: Path, ros2_controller: StartController, ros2_sim: StartRos2Simulator
) -> None:
    bags = []
    for _ in range(2):
        program = ros2_controller(command(tmp_path))
        tricycle = ros2_sim("tricycle", lockstep=TOPICS, seed=3)
        tricycle.run(3.0)
        tricycle.close()
        program.stop()
        bags.append(tricycle.bag.read_bytes())
    assert bags[0] == bags[1]


def test_a_controller_that_falls_silent_is_reported(
    tmp_path: Path, ros2_controller: StartController, ros2_sim: StartRos2Simulator
) -> None:
    ros2_controller(command(tmp_path, most=10))
    tricycle = ros2_sim("tricycle", lockstep=TOPICS)
    with pytest.raises(RunError, match=r"no message on /speed and /steering for 5 s: its publisher does not publish"):
        tricycle.run(5.0)
    assert tricycle.time == pytest.approx(0.6)


def test_a_controller_that_ends_is_reported_with_its_last_output(
    tmp_path: Path, ros2_controller: StartController, ros2_sim: StartRos2Simulator
) -> None:
    ros2_controller(command(tmp_path, most=10, then="os._exit(print('out of petrol', flush=True) or 1)"))
    tricycle = ros2_sim("tricycle", lockstep=TOPICS)
    with pytest.raises(RunError, match=r"ended with exit code 1; its last output:\n *out of petrol"):
        tricycle.run(5.0)


def test_a_topic_without_a_subscriber_is_reported(ros2_sim: StartRos2Simulator) -> None:
    tricycle = ros2_sim("tricycle", lockstep=["/spede"])
    with pytest.raises(RunError, match=r"lockstep waits: no script subscribes to /spede, given by --lockstep"):
        tricycle.run(1.0)


def test_a_missing_controller_is_reported(ros2_sim: StartRos2Simulator, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(any_simulator, "_STARTING_TIMEOUT", 0.0)
    tricycle = ros2_sim("tricycle", lockstep=TOPICS)
    with pytest.raises(RunError, match="for a controller that publishes /speed and /steering"):
        tricycle.run(1.0)


def test_a_scene_that_is_not_there_is_reported(ros2_sim: StartRos2Simulator) -> None:
    with pytest.raises(RunError, match=r"ended with exit code 2; its last output:\n.*did you mean tricycle\?"):
        ros2_sim("tricycel")


def test_without_lockstep_the_time_passes_as_fast_as_it_can(ros2_sim: StartRos2Simulator) -> None:
    ball = ros2_sim("ball", seed=1, options=["--script-path", "/nowhere"])
    ball.run(2.0)
    assert ball.position("/Ball")[2] == pytest.approx(0.1, abs=0.02)


def test_each_test_has_a_domain_of_its_own(ros2_domain: Ros2Domain) -> None:
    assert os.environ["ROS_DOMAIN_ID"] == str(ros2_domain.number)
    others = [reserve_domain() for _ in range(20)]
    for _, holder in others:
        holder.close()
    assert len({ros2_domain.number, *(number for number, _ in others)}) == 21


def test_nodes_of_ros2_do_not_see_the_packages_of_ros1(tmp_path: Path) -> None:
    workspace, other = tmp_path / "devel", tmp_path / "ros2"
    workspace.mkdir()
    other.mkdir()
    (workspace / ".catkin").touch()
    environment = {
        "CMAKE_PREFIX_PATH": f"{workspace}:{other}",
        "PYTHONPATH": f"{workspace}/lib/python3/dist-packages:{other}/lib:/mine",
        "LD_LIBRARY_PATH": f"{workspace}/lib",
    }
    assert without_ros1(environment) == {
        "CMAKE_PREFIX_PATH": f"{workspace}:{other}",
        "PYTHONPATH": f"{other}/lib:/mine",
    }


FAILS = """\
    def test_it_stands(ros2_sim):
        ball = ros2_sim("ball")
        ball.run(1.0)
        assert ball.time == 2.0
"""


def test_what_a_failed_test_leaves_is_kept(tmp_path: Path) -> None:
    run = bubblesim("test", write(tmp_path / "test_mine.py", FAILS), "--keep-failed=failed", cwd=tmp_path)
    assert run.returncode == 1, run.stdout + run.stderr
    kept = tmp_path / "failed" / "test_it_stands"
    assert len(list(read_messages(kept / "run1.mcap", "/tf"))) == 20  # one in each step of 50 ms
    assert (kept / "run1.png").read_bytes().startswith(b"\x89PNG")
