# SPDX-License-Identifier: BSD-3-Clause
"""The controller nodes as processes: starting, handing over the wheels, and ending."""

import contextlib
import signal
import subprocess
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from bubblesim.program.groups import signal_group
from ros_support import DEADLINE, REPOSITORY, RosCore, start, stop, wait_until

SCRIPTS = REPOSITORY / "scripts"
TOPICS = ("leftMotorSpeed", "/rightMotorSpeed", "/sensorTrigger", "/simTime")  # with and without leading slash
FORWARD, BACKWARD, HUMAN = 3.1415927, -3.1415927, 1.0

Run = Callable[..., "subprocess.Popen[str]"]


@pytest.fixture
def run(roscore: RosCore) -> Iterator[Run]:
    """Start processes that end with the test."""
    processes: list[subprocess.Popen[str]] = []

    def start_one(*command: str | Path, **options: object) -> "subprocess.Popen[str]":
        processes.append(start([str(part) for part in command], roscore.env, **options))
        return processes[-1]

    yield start_one
    for process in processes:  # all at once: ending takes time
        with contextlib.suppress(ProcessLookupError):
            signal_group(process, signal.SIGINT)
    for process in processes:
        stop(process)


class Echo:
    """Records the messages on a topic, with `rostopic echo`."""

    def __init__(self, run: Run, topic: str, file: Path) -> None:
        self._file = file
        with file.open("w") as output:
            run("rostopic", "echo", "-p", topic, stdout=output, stderr=subprocess.DEVNULL)

    def values(self) -> list[float]:
        lines = self._file.read_text().splitlines()
        return [float(line.split(",")[1]) for line in lines if "," in line and not line.startswith("%")]

    def last(self) -> float | None:
        """Return the newest value, None before the first."""
        return (self.values() or [None])[-1]


@pytest.fixture
def wheels(run: Run, roscore: RosCore, tmp_path: Path) -> tuple[Echo, Echo]:
    left = Echo(run, "/leftMotorSpeed", tmp_path / "left")
    right = Echo(run, "/rightMotorSpeed", tmp_path / "right")
    return left, right


def simulate(run: Run, sensed: bool = False) -> "subprocess.Popen[str]":
    """Publish simulated time like a simulation."""
    run("rostopic", "pub", "-r", "20", "/sensorTrigger", "std_msgs/Bool", str(sensed).lower())
    return run("rostopic", "pub", "-r", "20", "/simTime", "std_msgs/Float32", "1.0")


def test_bubblerob_drives_forward(run: Run, wheels: tuple[Echo, Echo]) -> None:
    simulate(run)
    run("/usr/bin/python3", SCRIPTS / "rosBubbleRob", *TOPICS)
    for wheel in wheels:
        wait_until(lambda wheel=wheel: pytest.approx(FORWARD) in wheel.values(), "a wheel to drive forward")


def test_bubblerob_backs_off_when_its_nose_senses(run: Run, wheels: tuple[Echo, Echo]) -> None:
    simulate(run, sensed=True)
    run("/usr/bin/python3", SCRIPTS / "rosBubbleRob", *TOPICS)
    wait_until(lambda: pytest.approx(BACKWARD) in wheels[0].values(), "the left wheel to drive backwards")


def test_bubblerob_yields_to_a_human_and_drives_on_afterwards(run: Run, wheels: tuple[Echo, Echo]) -> None:
    left, right = wheels
    simulate(run)
    run("/usr/bin/python3", SCRIPTS / "rosBubbleRob", *TOPICS)
    wait_until(lambda: pytest.approx(FORWARD) in right.values(), "the robot to drive")

    human = run("rostopic", "pub", "/leftMotorSpeed", "std_msgs/Float32", f"data: {HUMAN}")
    wait_until(lambda: right.last() == 0.0, "the wheel that the human leaves alone to stop")
    wait_until(lambda: left.last() == HUMAN, "the human's wheel to get the human's speed")
    count = len(right.values())
    time.sleep(0.5)
    assert len(right.values()) == count, "published although a human drives"

    stop(human)
    wait_until(lambda: right.last() == pytest.approx(FORWARD), "the robot to drive on")


def test_bubblerob_ends_when_the_simulation_is_silent(run: Run, wheels: tuple[Echo, Echo]) -> None:
    simulation = simulate(run)
    client = run("/usr/bin/python3", SCRIPTS / "rosBubbleRob", *TOPICS)
    wait_until(lambda: bool(wheels[0].values()), "the robot to drive")
    stop(simulation)
    assert client.wait(timeout=DEADLINE) == 0


def test_bubblerob_ends_quietly_when_it_is_terminated(run: Run, wheels: tuple[Echo, Echo]) -> None:
    simulate(run)
    client = run(
        "/usr/bin/python3", SCRIPTS / "rosBubbleRob", *TOPICS, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
    )
    wait_until(lambda: bool(wheels[0].values()), "the robot to drive")
    client.send_signal(signal.SIGTERM)
    output, _ = client.communicate(timeout=DEADLINE)
    assert client.returncode == 0
    assert output == ""


def test_bubblerob_stops_its_wheels_when_it_ends(run: Run, wheels: tuple[Echo, Echo]) -> None:
    simulate(run)
    client = run("/usr/bin/python3", SCRIPTS / "rosBubbleRob", *TOPICS)
    wait_until(lambda: all(wheel.values() for wheel in wheels), "both wheels to drive")
    client.send_signal(signal.SIGINT)
    client.wait(timeout=DEADLINE)
    for wheel in wheels:
        wait_until(lambda wheel=wheel: wheel.last() == 0.0, "a wheel to stop")


def test_tricycle_avoid_stops_the_tricycle_when_it_ends(run: Run, tmp_path: Path) -> None:
    speed = Echo(run, "/speed", tmp_path / "speed")
    run("rostopic", "pub", "-r", "20", "/front_sonar", "std_msgs/Float32", "3.0")
    client = run("/usr/bin/python3", SCRIPTS / "tricycle_avoid.py")
    wait_until(lambda: bool(speed.values()), "the tricycle to drive")
    client.send_signal(signal.SIGTERM)
    assert client.wait(timeout=DEADLINE) == 0
    wait_until(lambda: speed.last() == 0.0, "the tricycle to stop")


@pytest.mark.parametrize("script", ["rosBubbleRob", "tricycle_avoid.py"])
def test_nodes_explain_themselves(script: str) -> None:
    run = subprocess.run(["/usr/bin/python3", SCRIPTS / script, "--help"], capture_output=True, text=True, check=True)
    assert "usage:" in run.stdout


def test_bubblerob_refuses_missing_topics() -> None:
    run = subprocess.run(["/usr/bin/python3", SCRIPTS / "rosBubbleRob", "left"], capture_output=True, check=False)
    assert run.returncode == 2
