# SPDX-License-Identifier: BSD-3-Clause
"""The services that reset a simulation, called by other nodes."""

import re
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from node_support import NAME, PREFIX, Node, write
from ros_support import RosCore, wait_until

Start = Callable[[str], Node]


@pytest.fixture
def start(roscore: RosCore, tmp_path: Path) -> Iterator[Start]:
    """Run the ball with a test's script."""
    nodes = []

    def run(code: str) -> Node:
        file = write(tmp_path / "script.py", code)
        nodes.append(Node(roscore.env, tmp_path / "log", "ball", "--child-script", f"/Ball={file}"))
        wait_until(lambda: f"{NAME}/reset_simulation" in roscore.state()["services"], "the services")
        return nodes[-1]

    yield run
    for node in nodes:
        assert node.end() == (3 if "is disabled" in node.output else 0)


def times(output: str, what: str) -> list[float]:
    # Whole lines only: each word is written on its own.
    return [float(time) for time in re.findall(rf"^{what} (\S+).*\n", output, re.MULTILINE)]


def test_reset_puts_the_world_back_and_lets_time_and_scripts_go_on(start: Start, roscore: RosCore) -> None:
    node = start("""\
        def sysCall_init():
            print('init', sim.getSimulationTime())
        def sysCall_actuation():
            if sim.getSimulationTime() < 0.5:
                sim.setObjectPosition(sim.getObject('.'), [5, 5, 5])
                print('away')
            elif abs(sim.getObjectPosition(sim.getObject('.'))[0]) < 2:
                print('back', sim.getSimulationTime())
        """)
    node.wait_for_output("away")

    def back_after_a_reset() -> bool:
        roscore.run("rosservice", "call", f"{NAME}/reset")
        return bool(times(node.output, "back"))

    wait_until(back_after_a_reset, "the ball to be back")
    assert min(times(node.output, "back")) >= 0.5
    assert times(node.output, "init") == [0.0]


def test_reset_calls_scripts_and_their_odometry_starts_again(start: Start, roscore: RosCore) -> None:
    node = start("""\
        def sysCall_init():
            self.travelled = 0.0
        def sysCall_actuation():
            self.travelled += 1.0
        def sysCall_reset():
            self.travelled = 0.0
            print('reset', sim.getSimulationTime())
        def sysCall_sensing():
            print('travelled', self.travelled)
        """)
    node.wait_for_output("travelled 20.0")
    roscore.run("rosservice", "call", f"{NAME}/reset")
    node.wait_for_output("reset")
    wait_until(lambda: "travelled 1.0" in node.output.split("reset", 1)[1], "the odometry's new start")


def test_reset_simulation_starts_scripts_and_time_afresh(start: Start, roscore: RosCore) -> None:
    node = start("""\
        count = 0
        def sysCall_init():
            global count
            count += 1
            print('init', sim.getSimulationTime(), count, sim.getFloatSignal('left over'))
            sim.setFloatSignal('left over', 1.0)
            simROS.advertise('/of_the_script', 'std_msgs/Empty')
        def sysCall_cleanup():
            print('cleanup', sim.getSimulationTime())
        """)
    for starts in (1, 2, 3):
        wait_until(lambda starts=starts: len(times(node.output, "init")) == starts, "the script to start")
        wait_until(lambda: "/of_the_script" in roscore.state()["publishers"], "the script's topic")
        if starts < 3:
            roscore.run("rosservice", "call", f"{NAME}/reset_simulation")
    assert re.findall(r"^init (.*)", node.output, re.MULTILINE) == ["0.0 1 None"] * 3
    assert len(times(node.output, "cleanup")) == 2
    assert "error" not in node.output


def test_after_a_reset_stamps_start_at_0_at_once(start: Start, roscore: RosCore) -> None:
    roscore.set_param("/use_sim_time", True)
    node = start("""\
        def report(phase): print('stamp in', phase, simROS.getTime())
        def sysCall_init(): report('init')
        def sysCall_actuation():
            if sim.getSimulationTime() == 0: report('actuation')
        def sysCall_sensing():
            if sim.getSimulationTime() == 0: report('sensing')
        """)
    expected = ["stamp in init 0.0", "stamp in actuation 0.0", "stamp in sensing 0.05"]
    for starts in (1, 2):
        wait_until(lambda starts=starts: len(times(node.output, "stamp in sensing")) == starts, "the first step")
        if starts == 1:
            roscore.run("rosservice", "call", f"{NAME}/reset_simulation")
    reported = [line for line in PREFIX.sub("", node.output).splitlines() if line.startswith("stamp")]
    assert reported == 2 * expected


def test_a_script_that_asks_in_the_middle_of_itself_is_refused(start: Start) -> None:
    node = start(f"""\
        def sysCall_init():
            client = simROS.serviceClient('{NAME}/reset_simulation', 'std_srvs/Empty')
            simROS.call(client)
        """)
    node.wait_for_output("cannot restart the simulation that runs it")
