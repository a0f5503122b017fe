# SPDX-License-Identifier: BSD-3-Clause
"""The service that runs some steps of a paused simulation."""

import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml

from node_support import NAME, Node, write
from ros_support import RosCore, start, stop, wait_until

Paused = Callable[[str], Node]
IDLE = "def sysCall_init(): pass\n"


@pytest.fixture
def paused(roscore: RosCore, tmp_path: Path) -> Iterator[Paused]:
    """Run the ball with a test's script, paused."""
    nodes = []

    def run(code: str) -> Node:
        file = write(tmp_path / "script.py", code)
        nodes.append(Node(roscore.env, tmp_path / "log", "ball", "--paused", "--child-script", f"/Ball={file}"))
        wait_until(lambda: f"{NAME}/step" in roscore.state()["services"], "the service")
        return nodes[-1]

    yield run
    for node in nodes:
        if node.process.poll() is None:
            assert node.end() == 0


def step(core: RosCore, steps: int) -> Any:
    return yaml.safe_load(core.run("rosservice", "call", f"{NAME}/step", f"steps: {steps}"))


def test_so_many_passes_are_done_when_it_answers(paused: Paused, roscore: RosCore) -> None:
    node = paused(IDLE + "def sysCall_sensing(): print(f'pass {sim.getSimulationTime():.2f}')\n")
    assert step(roscore, 3) == {"success": True, "status_message": "", "time": pytest.approx(0.15)}
    assert step(roscore, 1)["time"] == pytest.approx(0.2)
    assert node.output.count("pass ") == 4
    assert step(roscore, 0) == {"success": True, "status_message": "", "time": pytest.approx(0.2)}


def test_scripts_receive_messages_in_the_steps(paused: Paused, roscore: RosCore) -> None:
    node = paused("""\
        def sysCall_init():
            simROS.subscribe('/in', 'std_msgs/Float32', receive)
        def receive(message):
            print('received at', sim.getSimulationTime())
        """)
    step(roscore, 1)  # the script subscribes
    wait_until(lambda: "/in" in roscore.state()["subscribers"], "the script's subscriber")
    command = [sys.executable, "-c", PUBLISH_WHILE_STEPPING.format(service=f"{NAME}/step")]
    stepping = start(command, roscore.env, stderr=subprocess.DEVNULL)  # the service ends with the node
    try:
        node.wait_for_output("received at")
        assert stepping.poll() is None, "the steps have ended"
        assert node.end() == 0
    finally:
        stop(stepping)


# The message is sent while the service runs: an earlier message would prove nothing.
PUBLISH_WHILE_STEPPING = """
import threading, time, rospy
from bubblesim_msgs.srv import Step
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Float32
rospy.init_node("stepping")
topic = rospy.Publisher("/in", Float32, queue_size=100)
while topic.get_num_connections() == 0:
    time.sleep(0.01)
threading.Thread(target=rospy.ServiceProxy("{service}", Step), args=(4000000000,)).start()
rospy.wait_for_message("/clock", Clock)
topic.publish(1.0)
"""


def test_a_running_simulation_is_to_be_paused_first(paused: Paused, roscore: RosCore) -> None:
    paused(IDLE)
    roscore.run("rosservice", "call", f"{NAME}/unpause")
    answer = step(roscore, 1)
    assert answer["success"] is False
    assert "pause it first" in answer["status_message"]


def test_a_second_request_meanwhile_is_refused_and_a_signal_ends_the_first(paused: Paused, roscore: RosCore) -> None:
    node = paused(IDLE + "def sysCall_sensing(): print(sim.getSimulationTime())\n")
    first = start(["rosservice", "call", f"{NAME}/step", "steps: 4000000000"], roscore.env, stdout=subprocess.DEVNULL)
    wait_until(lambda: "0.05" in node.output, "the first steps")
    answer = step(roscore, 1)
    assert answer["success"] is False
    assert "already being stepped" in answer["status_message"]
    assert node.end(signal.SIGTERM) == 0
    stop(first)
