# SPDX-License-Identifier: BSD-3-Clause
"""Actions of scripts with nodes of ROS 2, of Jazzy and of Kilted, both ways."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from node_support import Node, run_sim, write
from ros2_peer import KILTED_PEERS, PEERS, Domain, Ros2Peer
from ros_support import RosCore, wait_until

FIBONACCI = "test_msgs/action/Fibonacci"
SUCCEEDED, CANCELED, ABORTED = 4, 5, 6  # action_msgs/msg/GoalStatus


@pytest.fixture
def packages(tmp_path: Path) -> Path:
    """Return a folder with the package of the action, whose definition is ROS 2's."""
    package = tmp_path / "packages" / "test_msgs"
    (package / "action").mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>test_msgs</name></package>")
    (package / "action" / "Fibonacci.action").write_text("int32 order\n---\nint32[] sequence\n---\nint32[] sequence\n")
    return package.parent


@pytest.fixture(params=[PEERS, KILTED_PEERS], ids=["jazzy", "kilted"])
def peer(request: pytest.FixtureRequest, ros2_domain: Domain, tmp_path: Path) -> Iterator[Ros2Peer]:
    with Ros2Peer(ros2_domain, tmp_path / "peer.log", peers=request.param) as peer:
        yield peer


def node_with(domain: Domain, packages: Path, folder: Path, script: str) -> Node:
    file = write(folder / "script.py", script)
    env = domain.env(ROS_PACKAGE_PATH=str(packages))
    return Node(env, folder / "log", "ball", "--ros=2", "--child-script", f"/Ball={file}")


SERVER = """
    def sysCall_init():
        self.server = simROS2.createActionServer(
            '/count', 'test_msgs/action/Fibonacci', on_goal, on_cancel, on_accepted)
        self.running = {}

    def on_goal(goal_id, goal):
        return goal['order'] >= 0

    def on_cancel(goal_id, goal):
        return goal['order'] > 100

    def on_accepted(goal_id, goal):
        self.running[goal_id] = (goal['order'], [0, 1])

    def sysCall_sensing():
        for goal_id, (order, sequence) in list(self.running.items()):
            if simROS2.actionServerActionIsCanceling(self.server, goal_id):
                simROS2.actionServerActionCanceled(self.server, goal_id, {'sequence': sequence})
            elif order == 7:
                simROS2.actionServerActionAbort(self.server, goal_id, {})
            elif len(sequence) >= order:
                simROS2.actionServerActionSucceed(self.server, goal_id, {'sequence': sequence})
            else:
                sequence.append(sequence[-1] + sequence[-2] if len(sequence) < 40 else 0)
                simROS2.actionServerPublishFeedback(self.server, goal_id, {'sequence': sequence})
                continue
            del self.running[goal_id]
"""


def test_ros2_sends_goals_to_a_script(ros2_domain: Domain, peer: Ros2Peer, packages: Path, tmp_path: Path) -> None:
    with node_with(ros2_domain, packages, tmp_path, SERVER):
        assert peer.send_goal("/count", FIBONACCI, order=6)
        assert peer.result() == {"status": SUCCEEDED, "result": {"sequence": [0, 1, 1, 2, 3, 5]}}
        feedback = [each["sequence"] for each in peer.reported("feedback")]  # rclpy drops the last, if it is late
        assert feedback == [[0, 1, 1, 2, 3, 5][:length] for length in range(3, 3 + len(feedback))]
        assert feedback
        assert not peer.send_goal("/count", FIBONACCI, order=-1)
        assert peer.send_goal("/count", FIBONACCI, order=7)
        assert peer.result()["status"] == ABORTED


def test_ros2_cancels_a_goal_of_a_script(ros2_domain: Domain, peer: Ros2Peer, packages: Path, tmp_path: Path) -> None:
    with node_with(ros2_domain, packages, tmp_path, SERVER):
        assert peer.send_goal("/count", FIBONACCI, order=99)
        assert peer.cancel_goal() == {"code": 1, "goals": 0}  # the script rejects it
        assert peer.send_goal("/count", FIBONACCI, order=1000)
        assert peer.cancel_goal() == {"code": 0, "goals": 1}
        assert peer.result()["status"] in (CANCELED, SUCCEEDED)
        status = peer.next("/count/_action/status", "action_msgs/msg/GoalStatusArray", transient_local=True, depth=1)
        assert CANCELED in [each["status"] for each in status["status_list"]]


CLIENT = """
    def sysCall_init():
        self.client = simROS2.createActionClient(
            '/count', 'test_msgs/action/Fibonacci', on_response, on_feedback, on_result)
        self.orders = [5, -1, 1000]
        send()

    def send():
        self.cancelled = False
        simROS2.sendGoal(self.client, {'order': self.orders.pop(0)})

    def on_response(goal_id, accepted):
        print('accepted' if accepted else 'rejected', flush=True)
        if not accepted:
            send()

    def on_feedback(goal_id, feedback):
        print('feedback', feedback['sequence'].tolist(), flush=True)
        if len(feedback['sequence']) > 5 and not self.cancelled:
            self.cancelled = simROS2.cancelLastGoal(self.client)

    def on_result(goal_id, code, result):
        print('result', code, result['sequence'].tolist()[:5], flush=True)
        if self.orders:
            send()
"""


def test_a_script_sends_goals_to_ros2(ros2_domain: Domain, peer: Ros2Peer, packages: Path, tmp_path: Path) -> None:
    with node_with(ros2_domain, packages, tmp_path, CLIENT) as node:
        peer.act("/count")  # after the goal was sent: it waits for the server
        node.wait_for_output("result 4 [0, 1, 1, 2, 3]")
        node.wait_for_output("rejected")
        node.wait_for_output("result 5 [0, 1, 1, 2, 3]")
        assert "feedback [0, 1, 1, 2, 3]" in node.output
        assert node.output.count("accepted") == 2


def test_an_action_is_listed_as_one(ros2_domain: Domain, ros2_peer: Ros2Peer, packages: Path, tmp_path: Path) -> None:
    """By the names and types from which `ros2 action list -t` makes its list."""
    with node_with(ros2_domain, packages, tmp_path, SERVER):
        wait_until(lambda: "/count/_action/send_goal" in ros2_peer.graph()["services"], "the action")
        graph = ros2_peer.graph()
    assert graph["services"]["/count/_action/send_goal"] == [f"{FIBONACCI}_SendGoal"]
    assert graph["services"]["/count/_action/get_result"] == [f"{FIBONACCI}_GetResult"]
    assert graph["services"]["/count/_action/cancel_goal"] == ["action_msgs/srv/CancelGoal"]
    assert graph["topics"]["/count/_action/feedback"]["types"] == [f"{FIBONACCI}_FeedbackMessage"]
    assert graph["topics"]["/count/_action/status"]["types"] == ["action_msgs/msg/GoalStatusArray"]


def test_an_unknown_action_is_named_with_a_similar_one(ros2_domain: Domain, packages: Path, tmp_path: Path) -> None:
    script = """
        def sysCall_init():
            simROS2.createActionServer('/a', 'test_msgs/action/Fibonaci', print, print, print)
    """
    with node_with(ros2_domain, packages, tmp_path, script) as node:
        node.wait_for_output("test_msgs/Fibonaci has no definition")
        assert "did you mean test_msgs/Fibonacci?" in node.output


@pytest.mark.parametrize("version", ["1", "2"])
def test_the_types_of_ros2s_examples_are_there(
    ros2_domain: Domain, roscore: RosCore, tmp_path: Path, version: str
) -> None:
    script = """
        def sysCall_init():
            for part in ('Goal', 'Result', 'Feedback'):
                print(list(simROS2.createInterface(f'example_interfaces/action/Fibonacci{part}')))
            print(simROS2.createInterface('std_srvs/srv/SetBoolRequest'))
            print(simROS2.createInterface('tf2_msgs/srv/FrameGraph_Response'))  # it is not listed
            simROS2.createService('/add', 'example_interfaces/srv/AddTwoInts', lambda request: {'sum': 5})
            sim.quitSimulator()
    """
    file = write(tmp_path / "script.py", script)
    env = {**ros2_domain.env(), **roscore.env} if version == "1" else ros2_domain.env()
    run = run_sim("ball", f"--ros={version}", "--strict", "--child-script", f"/Ball={file}", env=env)
    assert run.returncode == 0, run.stderr
    assert run.stdout == "['order']\n['sequence']\n['sequence']\n{'data': False}\n{'frame_yaml': ''}\n"
