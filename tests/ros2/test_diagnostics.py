# SPDX-License-Identifier: BSD-3-Clause
"""The state of the simulation on /diagnostics."""

from pathlib import Path
from typing import Any

import pytest

from node_support import Node, write
from ros2_peer import Domain, Ros2Peer
from ros_support import RosCore

ARRAY = "diagnostic_msgs/msg/DiagnosticArray"
OK, WARN, ERROR = 0, 1, 2


def values(message: dict[str, Any]) -> dict[str, str]:
    (status,) = message["status"]
    return {each["key"]: each["value"] for each in status["values"]}


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
        (status,) = fine["status"]
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


@pytest.mark.usefixtures("roscore")
def test_both_sides_report_all_steps(
    roscore: RosCore, ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path
) -> None:
    """At 20 steps in each second; each side would get half of them if they shared a report."""
    with Node(roscore.env | ros2_domain.env(), tmp_path / "log", "ball", "--ros=both", "--speed=1"):
        ros2_peer.next("/diagnostics", ARRAY, count=4)
        steps = sum(int(values(each)["Steps"]) for each in ros2_peer.received("/diagnostics")[1:])
        first, last = (values(ros2_peer.received("/diagnostics")[at])["Simulation time (s)"] for at in (0, -1))
        assert steps == pytest.approx((float(last) - float(first)) / 0.05, abs=1.5)
