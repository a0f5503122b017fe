# SPDX-License-Identifier: BSD-3-Clause
"""The state of the simulation and the traffic of the node on /diagnostics."""

from pathlib import Path
from typing import Any

import pytest

from node_support import Node, write
from ros2_peer import Domain, Ros2Peer
from ros_support import RosCore, wait_until

ARRAY = "diagnostic_msgs/msg/DiagnosticArray"
OK, WARN, ERROR = 0, 1, 2


def values(message: dict[str, Any], status: int = 0) -> dict[str, str]:
    return {each["key"]: each["value"] for each in message["status"][status]["values"]}


def test_a_run_and_the_error_of_a_script_are_reported(ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path) -> None:
    code = """
        def sysCall_init():
            simROS2.createSubscription('/end', 'std_msgs/msg/Empty', lambda message: 1 / 0)
    """
    script = write(tmp_path / "script.py", code)
    options = ["ball", "--ros=2", "--speed=0.2", "--child-script", f"/Ball={script}"]
    with Node(ros2_domain.env(), tmp_path / "log", *options):

        def is_fine(message: dict[str, Any]) -> bool:
            return "running at real-time factor" in message["status"][0]["message"]

        fine = ros2_peer.wait_for("/diagnostics", ARRAY, is_fine, "a report of the run")
        status = fine["status"][0]
        assert status["name"] == "sim_ros2_interface: Simulation"
        assert (status["level"], status["hardware_id"]) in ((OK, "bubblesim"), (WARN, "bubblesim"))
        assert values(fine)["State"] == "running"
        assert int(values(fine)["Steps"]) > 0
        ros2_peer.publish("/end", "std_msgs/msg/Empty", {})

        def has_error(message: dict[str, Any]) -> bool:
            return "child scripts disabled after an error: 1" in message["status"][0]["message"]

        failed = ros2_peer.wait_for("/diagnostics", ARRAY, has_error, "the error")
        assert (failed["status"][0]["level"], values(failed)["Script errors"]) == (ERROR, "1")


def test_a_script_that_does_not_return_is_reported(ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path) -> None:
    code = """
        import time
        def sysCall_init():
            pass
        def sysCall_sensing():
            if sim.getSimulationTime() > 1.0:
                time.sleep(30.0)
    """
    script = write(tmp_path / "script.py", code)
    with Node(ros2_domain.env(), tmp_path / "log", "ball", "--ros=2", "--child-script", f"/Ball={script}"):

        def stands(message: dict[str, Any]) -> bool:
            return "no step has completed for" in message["status"][0]["message"]

        assert ros2_peer.wait_for("/diagnostics", ARRAY, stands, "the stall")["status"][0]["level"] == WARN


def test_traffic_and_messages_pushed_out_of_a_queue_are_counted(
    ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path
) -> None:
    """The script sends 5 messages of 8 bytes; those that it receives have 4. Its queue is of one message."""
    code = """
        import time

        def sysCall_init():
            self.out = simROS2.createPublisher('/out', 'std_msgs/msg/Float64', 10)
            self.sent = 0
            simROS2.createSubscription('/flood', 'std_msgs/msg/Float32', lambda message: None, 1)

        def sysCall_sensing():
            time.sleep(0.2)
            if simROS2.wantsMessages(self.out) and self.sent < 5:
                self.sent += 1
                simROS2.publish(self.out, {'data': 0.5})
    """
    script = write(tmp_path / "script.py", code)
    options = ["ball", "--ros=2", "--child-script", f"/Ball={script}"]
    with Node(ros2_domain.env(), tmp_path / "log", *options):

        def is_topics(message: dict[str, Any], level: int, begin: str) -> bool:
            topics = message["status"][1]
            assert topics["name"] == "sim_ros2_interface: Topics"
            return topics["level"] == level and topics["message"].startswith(begin)

        ros2_peer.wait_for("/diagnostics", ARRAY, lambda each: is_topics(each, OK, "nothing dropped"), "no drops")
        ros2_peer.next("/out", "std_msgs/msg/Float64", count=5)

        def drops() -> bool:
            for _ in range(20):
                ros2_peer.publish("/flood", "std_msgs/msg/Float32", {"data": 0.0})
            return any(is_topics(each, WARN, "/flood: ") for each in ros2_peer.received("/diagnostics"))

        wait_until(drops, "the drops")
        found = values(ros2_peer.next("/diagnostics"), status=1)
    assert 0 < int(found["Messages dropped"]) < int(found["Messages received"])
    assert int(found["Bytes received"]) == 4 * int(found["Messages received"])
    assert (found["Messages sent"], found["Bytes sent"]) == ("5", str(5 * 8))


@pytest.mark.usefixtures("roscore")
def test_both_sides_report_all_steps(
    roscore: RosCore, ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path
) -> None:
    """At 20 steps in each second; each side would get half of them if they shared a report."""
    with Node(roscore.env | ros2_domain.env(), tmp_path / "log", "ball", "--ros=both", "--speed=1"):
        ros2_peer.next("/diagnostics", ARRAY, count=4)
        reports = [values(each) for each in ros2_peer.received("/diagnostics")[:4]]
        steps = sum(int(each["Steps"]) for each in reports[1:])
        first, last = (reports[at]["Simulation time (s)"] for at in (0, -1))
        assert steps == pytest.approx((float(last) - float(first)) / 0.05, abs=1.5)
