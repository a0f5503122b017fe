# SPDX-License-Identifier: BSD-3-Clause
"""The node in the graph of ROS 2, its clock, and its scenes."""

import itertools
from pathlib import Path
from typing import Any

import pytest

from bubblesim import _core
from node_support import Node, run_sim, write
from ros2_peer import Domain, Ros2Peer
from ros_support import wait_until

NODE = "/sim_ros2_interface"


def publishers(peer: Ros2Peer, topic: str) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = peer.graph()["topics"].get(topic, {"publishers": []})["publishers"]
    return found


def test_node_and_types_are_known_by_name(ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path) -> None:
    with Node(ros2_domain.env(), tmp_path / "log", "tricycle", "--ros=2"):
        wait_until(lambda: any(each["node"] == NODE for each in publishers(ros2_peer, "/odom")), "/odom")
        graph = ros2_peer.graph()
    assert NODE in graph["nodes"]
    assert graph["topics"]["/odom"]["types"] == ["nav_msgs/msg/Odometry"]
    (odometry,) = graph["topics"]["/odom"]["publishers"]
    assert odometry["type_hash"] == _core.messages.type_hash("nav_msgs/Odometry", _core.messages.RosVersion.ROS2)
    (steering,) = graph["topics"]["/steering"]["subscribers"]
    assert (steering["node"], steering["reliability"]) == (NODE, "RELIABLE")
    assert graph["topics"]["/clock"]["types"] == ["rosgraph_msgs/msg/Clock"]


def test_the_clock_is_simulation_time(ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path) -> None:
    with Node(ros2_domain.env(), tmp_path / "log", "ball", "--ros=2"):
        ros2_peer.received("/clock", "rosgraph_msgs/msg/Clock", best_effort=True, depth=100)
        wait_until(lambda: len(ros2_peer.received("/clock")) > 20, "20 times")
    times = [
        message["clock"]["sec"] * 1000 + message["clock"]["nanosec"] // 1_000_000
        for message in ros2_peer.received("/clock")
    ]
    steps = {later - earlier for earlier, later in itertools.pairwise(times)}
    assert steps <= {0, 50}
    assert 50 in steps


STAMPS = """
    def sysCall_init():
        self.stamp = simROS2.createPublisher('/stamp', 'std_msgs/Header')

    def sysCall_sensing():
        simROS2.publish(self.stamp, {'stamp': simROS2.getTime()})
"""


@pytest.mark.parametrize("simulated", [False, True])
def test_stamps_follow_use_sim_time(ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path, simulated: bool) -> None:
    file = write(tmp_path / "script.py", STAMPS)
    options = ["--ros=2", "--child-script", f"/Ball={file}", *(["_use_sim_time:=true"] if simulated else [])]
    with Node(ros2_domain.env(), tmp_path / "log", "ball", *options):
        seconds = ros2_peer.next("/stamp", "std_msgs/msg/Header")["stamp"]["sec"]
    assert (seconds < 1_000_000) is simulated


def test_arguments_in_the_spelling_of_ros2(ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path) -> None:
    file = write(tmp_path / "script.py", STAMPS)
    rules = ["-r", "__ns:=/robots", "--remap", "sim:__node:=sim", "-r", "/stamp:=/other", "-p", "use_sim_time:=true"]
    options = ["--ros=2", "--ros-args", *rules, "--log-level", "info", "--", "--child-script", f"/Ball={file}"]
    with Node(ros2_domain.env(), tmp_path / "log", "ball", *options):
        assert ros2_peer.next("/other", "std_msgs/msg/Header")["stamp"]["sec"] < 1_000_000
        assert "/robots/sim" in ros2_peer.graph()["nodes"]


def test_two_simulators_of_a_domain_see_each_other(ros2_domain: Domain, tmp_path: Path) -> None:
    code = """
        def sysCall_init():
            self.out = simROS2.createPublisher('/{own}', 'std_msgs/String')
            simROS2.createSubscription('/{other}', 'std_msgs/String', 'on_other')

        def on_other(message):
            print('received', message['data'], flush=True)

        def sysCall_sensing():
            simROS2.publish(self.out, {{'data': '{own}'}})
    """
    scripts = {name: write(tmp_path / f"{name}.py", code.format(own=name, other=other)) for name, other in ("ab", "ba")}
    nodes = {
        name: Node(
            ros2_domain.env(), tmp_path / name, "ball", "--ros=2", f"__name:={name}", "--child-script", f"/Ball={file}"
        )
        for name, file in scripts.items()
    }
    with nodes["a"], nodes["b"]:
        nodes["a"].wait_for_output("received b")
        nodes["b"].wait_for_output("received a")


def test_a_node_that_was_killed_is_found_again(ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path) -> None:
    file = write(tmp_path / "script.py", STAMPS)
    for life in range(3):
        node = Node(ros2_domain.env(), tmp_path / f"log{life}", "ball", "--ros=2", "--child-script", f"/Ball={file}")
        with node:
            ros2_peer.next("/stamp", "std_msgs/msg/Header", count=3)
            node.process.kill()


def test_the_line_about_the_missing_master_names_ros2(ros2_domain: Domain) -> None:
    nowhere = ros2_domain.env(ROS_MASTER_URI="http://localhost:1", ROS_HOSTNAME="localhost")
    run = run_sim("ball", "--until=0.1", env=nowhere)
    assert "start one with 'roscore', or use ROS 2, which needs none: --ros 2 -- the simulation continues" in run.stderr


def test_ctrl_c_ends_the_node(ros2_domain: Domain, tmp_path: Path) -> None:
    with Node(ros2_domain.env(), tmp_path / "log", "ball", "--ros=2") as node:
        node.wait_for_output("load succeeded: node /sim_ros2_interface in domain ")
        assert node.end() == 0
        assert "error" not in node.output.lower()


@pytest.mark.parametrize(
    ("options", "env", "reported"),
    [
        (["--ros=3"], {}, "--ros: 3 not in {1,2,both}"),
        (["--ros=2", "--no-ros"], {}, "--ros excludes --no-ros"),
        (["--ros=2", "--record=a.bag"], {}, "--record: the files of ROS 2 are named FILE.mcap"),
        (["--record=a.mcap"], {}, "--record: .mcap is of ROS 2: --ros=2"),
        (["--ros=2", "--replace"], {}, "--replace: needs ROS 1"),
        (["--ros=2", "__name:=a/b"], {}, "invalid name for the ROS node: 'a/b' has a '/'"),
        (["--ros=2", "--ros-args", "-x", "1"], {}, "--ros-args: '-x' is not supported; -r, -p and those for logs are"),
        (["--ros=2", "--ros-args", "-r", "a"], {}, "-r needs NAME:=VALUE, found 'a'"),
        (["--ros=2", "--ros-args", "-p"], {}, "--ros-args: -p needs a value"),
        (["--ros=2"], {"ROS_DOMAIN_ID": "300"}, "ROS_DOMAIN_ID must be 0 to 232, found '300'"),
    ],
)
def test_what_is_not_possible_is_refused(
    ros2_domain: Domain, options: list[str], env: dict[str, str], reported: str
) -> None:
    run = run_sim("ball", "--until=0.1", *options, env=ros2_domain.env() | env)
    assert reported in run.stderr
    assert run.returncode == 2
