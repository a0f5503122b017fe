# SPDX-License-Identifier: BSD-3-Clause
"""The fixtures with which users test their controllers."""

import hashlib
import itertools
import os
import re
import shutil
import socket
import subprocess
import sys
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
import rosbag
import yaml

from bubblesim.running.processes import Program, Programs, RunError
from bubblesim.testing import any_simulator
from bubblesim.testing.master import Master, start_master
from bubblesim.testing.plugin import StartController, StartSimulator
from cli_support import bubblesim
from node_support import write
from ros2_peer import LIBRARY
from ros_support import REPOSITORY

AVOID = "rosrun bubblesim tricycle_avoid.py"
TOPICS = ["/speed", "/steering"]
ANSWERS_TEN = """\
    import rospy
    from std_msgs.msg import Float32
    rospy.init_node("mine")
    speed = rospy.Publisher("/speed", Float32, queue_size=1)
    left = [10]
    def answer(message):
        left[0] -= 1
        if left[0] < 0:
            {then}
        else:
            speed.publish(1.0)
    rospy.Subscriber("/front_sonar", Float32, answer)
    rospy.spin()
    raise SystemExit("out of petrol")
"""

TAKES_THE_WALL_CLOCK = """\
    import threading, time
    import rosgraph, rospy
    from rosgraph_msgs.msg import Clock
    from std_msgs.msg import Float32
    master = rosgraph.Master("/mine")
    while "/sim_ros_interface/step" not in str(master.getSystemState()):  # takes simulated time
        time.sleep(0.01)
    master.setParam("/use_sim_time", False)
    rospy.init_node("mine")
    speed = rospy.Publisher("/speed", Float32, queue_size=1)
    {answer}
    rospy.spin()
"""
WITHOUT_CLOCK = 'rospy.Subscriber("/front_sonar", Float32, lambda message: speed.publish(1.0))'
CLOCK_LATER = """received = threading.Event()
    def answer(message):
        if received.wait(4.0):
            speed.publish(1.0)
    rospy.Subscriber("/front_sonar", Float32, answer)
    time.sleep(0.6)
    rospy.Subscriber("/clock", Clock, lambda message: received.set())"""

BY_THE_CLOCK = """\
    import rospy
    from std_msgs.msg import Float32
    rospy.init_node("mine")
    speed = rospy.Publisher("/speed", Float32, queue_size=1)
    rospy.Subscriber("/front_sonar", Float32, lambda message: None)
    while speed.get_num_connections() == 0:
        rospy.rostime.wallsleep(0.01)
    rate = rospy.Rate(20)
    while not rospy.is_shutdown():
        speed.publish(rospy.get_time())
        rate.sleep()
"""


STARTS_WHEN_HEARD = """\
    import time

    def sysCall_init():
        self.steps = 0
        self.publisher = simROS.advertise("/front_sonar", "std_msgs/Float32")
        simROS.subscribe("/speed", "std_msgs/Float32", lambda message: None)
        while not simROS.wantsMessages(self.publisher):
            time.sleep(0.01)
        time.sleep(0.5)  # until the subscriber is connected, too

    def sysCall_sensing():
        self.steps += 1
        simROS.publish(self.publisher, {"data": float(self.steps)})
"""
ECHOES = """\
    import rospy
    from std_msgs.msg import Float32
    rospy.init_node("mine")
    speed = rospy.Publisher("/speed", Float32, queue_size=1)
    rospy.Subscriber("/front_sonar", Float32, lambda message: speed.publish(message.data))
    rospy.spin()
"""


@pytest.fixture
def ten(tmp_path: Path) -> str:
    """Write a controller that answers ten times, and then no more."""
    return f"/usr/bin/python3 {write(tmp_path / 'ten.py', ANSWERS_TEN.format(then='pass'))}"


def all_messages(bag: Path) -> list[tuple[str, float, str]]:
    """Return topic, simulated seconds and content of each message."""
    with rosbag.Bag(str(bag)) as opened:
        return [(topic, stamp.to_sec(), str(message)) for topic, message, stamp in opened.read_messages()]


def test_the_page_about_testing_is_right(tmp_path: Path) -> None:
    code = re.findall(
        r"^```python\n(.*?)^```", (REPOSITORY / "docs" / "testing.md").read_text(), re.MULTILINE | re.DOTALL
    )
    code = [block for block in code if "def test_" in block and (LIBRARY.exists() or "ros2_sim" not in block)]
    for number, block in enumerate(code):
        (tmp_path / f"test_block_{number}.py").write_text(block)
    run = bubblesim("test", tmp_path)
    assert run.returncode == 0, run.stdout + run.stderr
    assert f"{len(code)} passed" in run.stdout


def test_failed_tests_give_1_and_none_2(tmp_path: Path) -> None:
    failing = write(tmp_path / "test_failing.py", "def test_it(): assert False\n")
    assert bubblesim("test", failing).returncode == 1
    assert bubblesim("test", failing, "-k", "other").returncode == 2
    assert bubblesim("test", tmp_path / "none.py").returncode == 2


def test_equal_runs_give_equal_bags(controller: StartController, sim: StartSimulator) -> None:
    bags = []
    for _ in range(2):
        program = controller(AVOID)
        tricycle = sim("tricycle", lockstep=TOPICS, seed=3)
        tricycle.run(20.0)
        tricycle.close()
        program.stop()
        bags.append(tricycle.bag)
    for first, second in itertools.zip_longest(*map(all_messages, bags)):  # shows more than the checksums
        assert first == second
    assert len({hashlib.sha256(bag.read_bytes()).hexdigest() for bag in bags}) == 1


def test_the_controller_drives_and_its_messages_are_known(controller: StartController, sim: StartSimulator) -> None:
    controller(AVOID)
    tricycle = sim("tricycle", lockstep=TOPICS)
    start = tricycle.position("/Tricycle")
    tricycle.run(5.0)
    assert tricycle.time == pytest.approx(5.0)
    assert tricycle.position("/Tricycle")[0] > start[0] + 0.1
    assert tricycle.orientation("/Tricycle")[3] == pytest.approx(1.0, abs=0.1)
    with pytest.raises(LookupError, match="did you mean /Tricycle"):
        tricycle.position("/Tricycl")
    speeds = tricycle.messages("/speed")
    assert len(speeds) == 98  # 100 steps; the first has no subscriber yet, the last no answer yet
    assert speeds[0][1].data == pytest.approx(0.525)  # 0.5 rad/s, 5 % more with each answer
    assert speeds[1][0] - speeds[0][0] == pytest.approx(0.05)


def test_a_controller_gets_no_message_of_the_first_step_however_early_it_subscribes(
    tmp_path: Path, controller: StartController, sim: StartSimulator
) -> None:
    controller(f"/usr/bin/python3 {write(tmp_path / 'echoes.py', ECHOES)}")
    script = write(tmp_path / "starts_when_received.py", STARTS_WHEN_HEARD)
    tricycle = sim("tricycle", lockstep=["/speed"], options=["--child-script", f"/Tricycle={script}"])
    tricycle.run(0.2)
    assert [message.data for _, message in tricycle.messages("/speed")] == [2.0, 3.0]


@pytest.mark.parametrize("answer", [WITHOUT_CLOCK, CLOCK_LATER], ids=["never", "later than the rest"])
def test_a_controller_may_subscribe_to_the_clock(
    tmp_path: Path, controller: StartController, sim: StartSimulator, answer: str
) -> None:
    code = write(tmp_path / "mine.py", TAKES_THE_WALL_CLOCK.format(answer=answer))
    controller(f"/usr/bin/python3 {code}")
    tricycle = sim("tricycle", lockstep=["/speed"])
    tricycle.run(0.5)
    assert tricycle.time == pytest.approx(0.5)


def test_a_controller_with_a_rate_answers_each_time_of_the_clock(
    tmp_path: Path, controller: StartController, sim: StartSimulator
) -> None:
    controller(f"/usr/bin/python3 {write(tmp_path / 'mine.py', BY_THE_CLOCK)}")
    tricycle = sim("tricycle", lockstep=["/speed"])
    tricycle.run(2.0)
    speeds = tricycle.messages("/speed")
    # From the end of the first step on; each arrives before the step that starts at the time that it shows.
    assert [time for time, _ in speeds] == pytest.approx([0.05 * n for n in range(1, 40)])
    assert [message.data for _, message in speeds] == pytest.approx([time for time, _ in speeds], abs=1e-5)


def test_a_controller_that_falls_silent_is_reported(ten: str, controller: StartController, sim: StartSimulator) -> None:
    controller(ten)
    tricycle = sim("tricycle", lockstep=["/speed"])
    with pytest.raises(RunError, match=r"no message on /speed for 5 s: its publisher does not publish"):
        tricycle.run(5.0)
    assert tricycle.time == pytest.approx(0.6)


def test_a_controller_that_ends_is_reported_with_its_last_output(
    tmp_path: Path, controller: StartController, sim: StartSimulator
) -> None:
    code = ANSWERS_TEN.format(then="rospy.signal_shutdown('enough')")
    controller(f"/usr/bin/python3 {write(tmp_path / 'ten.py', code)}")
    tricycle = sim("tricycle", lockstep=["/speed"])
    with pytest.raises(
        RunError, match=r"the controller ten.py ended with exit code 1; its last output:\n *out of petrol"
    ):
        tricycle.run(5.0)


def test_a_topic_without_a_subscriber_is_reported(sim: StartSimulator) -> None:
    tricycle = sim("tricycle", lockstep=["/spede"])
    with pytest.raises(RunError, match=r"lockstep waits: no script subscribes to /spede, given by --lockstep"):
        tricycle.run(1.0)


def test_a_controller_may_start_late(tmp_path: Path, controller: StartController, sim: StartSimulator) -> None:
    tricycle = sim("tricycle", lockstep=["/speed"])
    late = "    import time\n    time.sleep(6.0)\n"  # longer than the node waits for an answer
    code = late + ECHOES.replace("message.data", "1.0")
    controller(f"/usr/bin/python3 {write(tmp_path / 'mine.py', code)}")
    tricycle.run(0.5)
    assert tricycle.time == pytest.approx(0.5)


def test_a_missing_controller_is_reported(sim: StartSimulator, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(any_simulator, "_STARTING_TIMEOUT", 0.0)
    tricycle = sim("tricycle", lockstep=TOPICS)
    with pytest.raises(RunError, match="for a controller that publishes /speed and /steering"):
        tricycle.run(1.0)


def test_a_scene_that_is_not_there_is_reported(sim: StartSimulator) -> None:
    with pytest.raises(
        RunError, match=r"the simulator ended with exit code 2; its last output:\n.*did you mean tricycle\?"
    ):
        sim("tricycel")


def test_a_controller_that_is_not_there_is_reported(controller: StartController) -> None:
    with pytest.raises(RunError, match="cannot start the controller no_such_program"):
        controller("no_such_program")


def test_without_lockstep_the_time_passes_as_fast_as_it_can(sim: StartSimulator) -> None:
    ball = sim("ball", seed=1, options=["--script-path", "/nowhere"])
    ball.run(2.0)
    assert ball.position("/Ball")[2] == pytest.approx(0.1, abs=0.02)


def test_everything_knows_the_master(ros_master: Master) -> None:
    assert os.environ["ROS_MASTER_URI"] == ros_master.uri
    assert ros_master.find_service("/none") is None


class WithARival(Programs):
    """Starts a program after another has tried to get the port that is its last argument."""

    def start(self, name: str, *command: str, **options: Any) -> Program:
        with socket.socket() as other, pytest.raises(OSError, match="in use"):
            other.bind(("127.0.0.1", int(command[-1])))
        return super().start(name, *command, **options)


def test_no_other_process_gets_the_port_of_the_master_while_it_starts(tmp_path: Path) -> None:
    with WithARival(tmp_path) as programs:
        assert start_master(programs).answers()


def _pytest_of(python: Path, tests: Path, **environment: str) -> "subprocess.CompletedProcess[str]":
    """Run tests with the fixtures by a Python without Debian's packages."""
    command = [python, "-m", "pytest", "-q", "-p", "no:cacheprovider", tests]
    return subprocess.run(command, env=os.environ | environment, capture_output=True, text=True, check=False)


@pytest.fixture
def foreign(tmp_path: Path) -> Path:
    """A Python that has Debian's packages but numpy."""
    subprocess.run(["/usr/bin/python3", "-m", "venv", "--without-pip", tmp_path / "venv"], check=True)
    (packages,) = (tmp_path / "venv").glob("lib/python3*/site-packages")
    for place in Path("/usr/lib/python3/dist-packages").iterdir():
        if not place.name.startswith("numpy") and not (packages / place.name).exists():
            (packages / place.name).symlink_to(place)
    (tmp_path / "conftest.py").write_text('pytest_plugins = ["bubblesim.testing.plugin"]\n')
    (tmp_path / "test_mine.py").write_text("def test_it(sim): sim('ball').run(0.1)\n")
    return tmp_path / "venv" / "bin" / "python"


def test_a_python_without_debians_packages_is_one_line(tmp_path: Path, foreign: Path) -> None:
    run = _pytest_of(foreign, tmp_path / "test_mine.py")
    line = (
        f"ERROR: {foreign} cannot load bubblesim: No module named 'numpy' -- `bubblesim test` runs tests with a Python "
    )
    assert run.stderr.strip() == f"{line}that can"
    assert (run.returncode, run.stdout) == (4, "")


def test_a_python_of_another_version_is_one_line(tmp_path: Path, foreign: Path) -> None:
    package = tmp_path / "bubblesim"  # with a module for another version
    shutil.copytree(REPOSITORY / "python" / "bubblesim", package, ignore=shutil.ignore_patterns("__pycache__"))
    (package / "_core.cpython-39-x86_64-linux-gnu.so").write_bytes(b"")
    run = _pytest_of(foreign, tmp_path / "test_mine.py", PYTHONPATH=str(tmp_path))
    assert f"cannot load bubblesim: bubblesim was built for Python 3.9, this is 3.{sys.version_info[1]}" in run.stderr
    assert len(run.stderr.strip().splitlines()) == 1


def test_a_missing_pytest_is_named(tmp_path: Path, foreign: Path) -> None:
    for package in foreign.parent.parent.glob("lib/python3*/site-packages/*pytest*"):
        package.unlink()
    run = bubblesim("test", tmp_path / "test_mine.py", env=os.environ | {"VIRTUAL_ENV": str(tmp_path / "venv")})
    assert run.returncode == 2
    assert run.stderr == f"error: {foreign} has no pytest: {foreign} -m pip install pytest\n"


FAILS = """\
    def test_it_stands(sim):
        tricycle = sim("ball")
        tricycle.run(1.0)
        assert tricycle.time == 2.0

    def test_it_passes(sim):
        sim("ball").run(0.1)
"""


@pytest.mark.parametrize("workflow", ["github.yml", "gitlab.yml"])
def test_the_command_of_a_workflow_reports_and_keeps_what_failed(tmp_path: Path, workflow: str) -> None:
    text = (REPOSITORY / "config" / "ci" / workflow).read_text()
    assert yaml.safe_load(text)
    command = re.search(r"&& (bubblesim test .*?)\"?$", text, re.MULTILINE)
    assert command
    (tmp_path / "tests").mkdir()
    write(tmp_path / "tests" / "test_mine.py", FAILS)
    run = bubblesim(*command[1].split()[1:], cwd=tmp_path)
    assert run.returncode == 1, run.stderr
    suite = ElementTree.parse(tmp_path / "results.xml").getroot()[0]
    assert (suite.get("tests"), suite.get("failures"), suite.get("errors")) == ("2", "1", "0")
    kept = suite.find("./testcase[@name='test_it_stands']/properties/property[@name='kept']")
    assert kept is not None
    assert kept.get("value") == str(tmp_path / "failed" / "test_it_stands")
    assert [entry.name for entry in (tmp_path / "failed").iterdir()] == ["test_it_stands"]
    with rosbag.Bag(str(tmp_path / "failed" / "test_it_stands" / "run1.bag")) as bag:
        assert bag.get_message_count("/tf") == 20  # the ball's script publishes its transform in each step of 50 ms
    plot = (tmp_path / "failed" / "test_it_stands" / "run1.png").read_bytes()
    assert plot.startswith(b"\x89PNG")
