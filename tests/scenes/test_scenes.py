# SPDX-License-Identifier: BSD-3-Clause
"""The scenes through ordinary ROS tools, as the tutorials use them."""

import math
import re
import signal
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
import yaml

from node_support import NAME, Node, processes_with
from ros_support import DEADLINE, RosCore, start, stop, wait_until

StartNode = Callable[..., Node]
ENDED = (0, -signal.SIGINT)  # on a busy machine it ends before it and its client have cleaned up


@pytest.fixture
def node(roscore: RosCore, tmp_path: Path) -> Iterator[StartNode]:
    """Start the node with a scene; all its processes end with it."""
    nodes: list[Node] = []

    def start_node(scene: str, *options: object) -> Node:
        nodes.append(Node(roscore.env, tmp_path / f"log{len(nodes)}", scene, *options))
        nodes[-1].wait_until_listed(roscore)
        return nodes[-1]

    yield start_node
    for running in nodes:
        if running.process.poll() is None:
            assert running.end() in ENDED
    roscore.forget_ended_nodes()
    wait_until(lambda: NAME not in roscore.nodes(), "the node to leave the master")
    assert processes_with(f"localhost:{roscore.port} ") == []


def number(text: str, name: str = "data") -> float:
    found = re.search(rf"\b{name}: (\S+)", text)
    assert found is not None, text
    return float(found[1])


def pose(core: RosCore) -> tuple[float, float, float]:
    """Return x, y and heading of the last transform on /tf."""
    text = core.echo("/tf")
    translation, rotation = text.split("rotation:")
    x, y = (number(translation.split("translation:")[1], axis) for axis in "xy")
    return x, y, 2 * math.atan2(number(rotation, "z"), number(rotation, "w"))


def joint_position(core: RosCore, name: str) -> float:
    states = yaml.safe_load(core.echo("/joint_states").partition("---")[0])
    return float(states["position"][states["name"].index(name)])


def test_the_tricycle_takes_velocities_and_stops_when_none_come(
    roscore: RosCore, node: StartNode, tmp_path: Path
) -> None:
    node("tricycle_cmd_vel")
    wait_until(lambda: "/cmd_vel" in roscore.state()["subscribers"], "the tricycle to listen")
    x, _, _ = pose(roscore)
    command = ["rostopic", "pub", "-r", "10", "/cmd_vel", "geometry_msgs/Twist", "[0.5, 0, 0]", "[0, 0, 0.25]"]
    driver = start(command, roscore.env)
    wait_until(lambda: pose(roscore)[0] > x + 0.5, "the tricycle to drive")
    _, _, before = pose(roscore)
    wait_until(lambda: math.remainder(pose(roscore)[2] - before, math.tau) > 0.1, "the tricycle to turn left")
    stop(driver)

    def stands() -> bool:
        first = pose(roscore)
        return math.dist(first, pose(roscore)) < 1e-3

    wait_until(stands, "the tricycle to stop")


def test_standard_tools_see_the_node(roscore: RosCore, node: StartNode) -> None:
    node("tricycle")
    assert NAME in roscore.run("rosnode", "list").split()
    wait_until(lambda: "/front_sonar" in roscore.state()["publishers"], "the sonar's topic")
    assert {"/clock", "/front_sonar", "/tf", "/speed", "/steering"} <= set(roscore.run("rostopic", "list").split())
    assert roscore.run("rostopic", "type", "/front_sonar") == "std_msgs/Float32\n"
    assert roscore.run("rosmsg", "show", "test_msgs/Notification") == "string messages\n\n"


def test_tricycle_turns_as_it_is_steered(roscore: RosCore, node: StartNode) -> None:
    node("tricycle")
    wait_until(lambda: "/steering" in roscore.state()["subscribers"], "the steering's topic")
    with roscore.publishing("/steering", "std_msgs/Float32", "--", "-1.0"):
        wait_until(lambda: joint_position(roscore, "Steering") < -0.9, "the front wheel to be steered")
    with roscore.publishing("/speed", "std_msgs/Float32", "0.5"):
        x, y, heading = pose(roscore)
        wait_until(lambda: math.dist(pose(roscore)[:2], (x, y)) > 0.02, "the tricycle to move")
    turned = math.remainder(pose(roscore)[2] - heading, math.tau)
    assert turned < 0  # clockwise, to the right
    assert math.isinf(number(roscore.echo("/front_sonar"))) or number(roscore.echo("/front_sonar")) > 0


def test_bubblerob_obeys_a_human_although_its_client_runs(roscore: RosCore, node: StartNode) -> None:
    running = node("bubblerob")
    wait_until(lambda: any(name.startswith("/rosBubbleRob") for name in roscore.nodes()), "the client")
    topic = next(name for name in roscore.state()["subscribers"] if name.startswith("/leftMotorSpeed"))
    assert "messages: " in roscore.echo("/notifications")
    assert processes_with(f"rosBubbleRob {topic[1:]}", started_by=running)
    human = start(["rostopic", "pub", topic, "std_msgs/Float32", "data: 1.0"], roscore.env)
    try:
        wait_until(lambda: "it has control now" in running.output, "the client to yield")
        # Circling about the right wheel: that wheel's place, 0.05 ahead and 0.1 to the right, stands still.
        wait_until(lambda: speed_of_right_wheel(roscore) < 1e-3, "the right wheel to stand still")
        wheel, (_, _, heading) = right_wheel(roscore), pose(roscore)
        wait_until(lambda: abs(math.remainder(pose(roscore)[2] - heading, math.tau)) > 0.3, "the robot to turn")
        assert math.dist(right_wheel(roscore), wheel) < 0.01
    finally:
        stop(human)
    assert running.end() in ENDED
    assert processes_with("rosBubbleRob", started_by=running) == []
    roscore.forget_ended_nodes()
    wait_until(lambda: not any(name.startswith("/rosBubbleRob") for name in roscore.nodes()), "the client to leave")


def test_several_bubblerobs_drive_at_once_each_by_its_own_client(roscore: RosCore, node: StartNode) -> None:
    node("bubblerobs", "--speed", "2")
    frames = ("base_link", "base_link_0", "base_link_1")

    def drivers() -> dict[str, list[str]]:
        return {topic: nodes for topic, nodes in roscore.state()["publishers"].items() if "MotorSpeed" in topic}

    wait_until(lambda: len(drivers()) == 6, "the clients")
    assert sorted(len(nodes) for nodes in drivers().values()) == [1] * 6
    assert len({nodes[0] for nodes in drivers().values()}) == 3

    def places() -> dict[str, tuple[float, float]]:
        text = roscore.echo("/tf", count=12)
        found = {}
        for transform in text.split("child_frame_id: ")[1:]:
            frame = transform.split('"')[1]
            found[frame] = number(transform, "x"), number(transform, "y")
        return found

    before = places()
    assert set(before) == set(frames)
    moved: set[str] = set()

    def all_moved() -> bool:
        now = places()
        moved.update(frame for frame in now if math.dist(now[frame], before[frame]) > 0.05)
        return moved == set(frames)

    wait_until(all_moved, "all of them to drive", 3 * DEADLINE)


def right_wheel(core: RosCore) -> tuple[float, float]:
    x, y, heading = pose(core)
    cos, sin = math.cos(heading), math.sin(heading)
    return x + 0.05 * cos + 0.1 * sin, y + 0.05 * sin - 0.1 * cos


def speed_of_right_wheel(core: RosCore) -> float:
    """Return the distance, in metres, that the right wheel moves between two measurements."""
    return math.dist(right_wheel(core), right_wheel(core))


def test_bubblerob_notifies(roscore: RosCore, node: StartNode) -> None:
    node("bubblerob")
    assert roscore.echo("/notifications") == 'messages: "ok"\n---\n'


def test_ball_publishes_time_and_place(roscore: RosCore, node: StartNode) -> None:
    node("ball")
    first = number(roscore.echo("/simulationTime"))
    assert number(roscore.echo("/simulationTime")) > first
    transform = roscore.echo("/tf")
    assert 'frame_id: "world"' in transform
    assert 'child_frame_id: "Ball"' in transform


def test_stamps_are_simulation_time_under_use_sim_time(roscore: RosCore, node: StartNode) -> None:
    roscore.set_param("/use_sim_time", True)
    node("ball")
    stamp = number(roscore.echo("/tf"), "secs")
    assert stamp < 1000
    assert number(roscore.echo("/clock"), "secs") >= stamp


def test_stamps_are_wall_time_otherwise(roscore: RosCore, node: StartNode) -> None:
    node("ball")
    assert number(roscore.echo("/tf"), "secs") > 1e9
