# SPDX-License-Identifier: BSD-3-Clause
"""The node's messages on /diagnostics, received by rospy."""

import json
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from node_support import Node, endless_fall, write
from ros_support import RosCore, start, stop, wait_until

SIMULATION, TOPICS = "sim_ros_interface: Simulation", "sim_ros_interface: Topics"
OK, WARN, ERROR = 0, 1, 2

# Prints each status as a line of JSON.
LISTENER = """
import json, rospy
from diagnostic_msgs.msg import DiagnosticArray
def receive(message):
    for s in message.status:
        values = {v.key: v.value for v in s.values}
        print(json.dumps([s.name, s.level, s.message, s.hardware_id, values]), flush=True)
rospy.init_node('listener')
subscriber = rospy.Subscriber('/diagnostics', DiagnosticArray, receive)
rospy.spin()
"""


class Diagnostics:
    def __init__(self, log: Path) -> None:
        self._log = log

    def all(self, name: str) -> list[list[Any]]:
        lines = self._log.read_text().splitlines(keepends=True)
        return [
            status for status in map(json.loads, (line for line in lines if line.endswith("\n"))) if status[0] == name
        ]

    def wait_for(self, name: str, condition: Callable[[int, str, dict[str, str]], bool], what: str) -> None:
        wait_until(lambda: any(condition(s[1], s[2], s[4]) for s in self.all(name)), what)


@pytest.fixture
def received(roscore: RosCore, tmp_path: Path) -> Iterator[Diagnostics]:
    log = tmp_path / "received"
    with log.open("w") as file:
        process = start(["/usr/bin/python3", "-c", LISTENER], roscore.env, stdout=file, stderr=subprocess.DEVNULL)
        wait_until(lambda: "/diagnostics" in roscore.state()["subscribers"], "the listener")
        yield Diagnostics(log)
        stop(process)


def test_a_simulation_that_runs_well_and_one_that_is_paused_are_fine(
    roscore: RosCore, received: Diagnostics, tmp_path: Path
) -> None:
    with Node(roscore.env, tmp_path / "log", "ball", "--speed", "0.2") as node:
        received.wait_for(
            SIMULATION, lambda level, text, _: level == OK and "running at real-time" in text, "a fine run"
        )
        roscore.run("rosservice", "call", "/sim_ros_interface/pause")
        received.wait_for(SIMULATION, lambda level, text, _: (level, text) == (OK, "paused"), "the pause")
        before = len(received.all(SIMULATION))
        wait_until(lambda: len(received.all(SIMULATION)) > before + 1, "messages while paused")
        assert node.end() == 0
    status = next(s for s in received.all(SIMULATION) if s[1] == OK and "running at real-time" in s[2])
    assert status[3] == "bubblesim"
    assert status[4]["State"] == "running"
    assert int(status[4]["Steps"]) > 0
    assert float(status[4]["Step time, longest (ms)"]) >= float(status[4]["Step time, mean (ms)"]) > 0
    assert float(status[4]["Wanted real-time factor"]) == 0.2


def test_slow_passes_and_a_failed_script_are_reported(roscore: RosCore, received: Diagnostics, tmp_path: Path) -> None:
    code = """\
        import time
        def sysCall_init():
            simROS.subscribe('/end', 'std_msgs/Empty', lambda message: 1 / 0)
        def sysCall_actuation():
            time.sleep(0.2)
        """
    script = write(tmp_path / "script.py", code)
    with Node(roscore.env, tmp_path / "log", "ball", "--child-script", f"/Ball={script}") as node:
        received.wait_for(SIMULATION, lambda level, text, _: level == WARN and text.endswith("wanted 1.00"), "slowness")
        reported = "child scripts disabled after an error: 1"
        with roscore.publishing("/end", "std_msgs/Empty"):
            received.wait_for(
                SIMULATION, lambda level, text, _: level == ERROR and reported in text, "the failed script"
            )
        assert node.end() == 3  # a script failed
    assert received.all(SIMULATION)[-1][4]["Script errors"] == "1"


def test_messages_pushed_out_of_a_queue_are_counted(roscore: RosCore, received: Diagnostics, tmp_path: Path) -> None:
    code = """\
        def sysCall_init():
            simROS.subscribe('/flood', 'std_msgs/Empty', lambda message: None, 1)
        """
    script = write(tmp_path / "script.py", code)
    with Node(roscore.env, tmp_path / "log", "ball", "--child-script", f"/Ball={script}"):
        received.wait_for(TOPICS, lambda level, text, _: (level, text) == (OK, "nothing dropped"), "no drops")
        flood = start(
            ["rostopic", "pub", "-r", "200", "/flood", "std_msgs/Empty"], roscore.env, stdout=subprocess.DEVNULL
        )
        try:
            received.wait_for(TOPICS, lambda level, text, _: level == WARN and text.startswith("/flood: "), "the drops")
        finally:
            stop(flood)
    values = received.all(TOPICS)[-1][4]
    assert 0 < int(values["Messages dropped"]) < int(values["Messages received"])
    assert int(values["Bytes sent"]) > int(values["Messages sent"]) > 0


def test_a_simulation_that_diverges_reports_that(roscore: RosCore, received: Diagnostics, tmp_path: Path) -> None:
    with Node(roscore.env, tmp_path / "log", endless_fall(tmp_path), "--paused") as node:
        received.wait_for(SIMULATION, lambda level, text, _: (level, text) == (OK, "paused"), "the pause")
        roscore.run("rosservice", "call", "/sim_ros_interface/unpause")
        received.wait_for(SIMULATION, lambda level, text, _: level == ERROR and "/Ball" in text, "the end")
        assert node.process.poll() is None, "paused: others may put the world back"
