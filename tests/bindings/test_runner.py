# SPDX-License-Identifier: BSD-3-Clause
"""A simulation that runs in the background: commands, answers, frames."""

import math
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator

import numpy as np
import pytest

import bubblesim
from bubblesim import RunState
from interrupted_program import errors_of_interrupted


@pytest.fixture
def runner() -> Iterator[bubblesim.Runner]:
    with bubblesim.Runner(bubblesim.Simulation("tricycle"), speed=math.inf) as running:
        yield running


def test_it_begins_paused_and_steps_when_asked(runner: bubblesim.Runner) -> None:
    assert runner.state == RunState.PAUSED
    assert runner.step(20) == pytest.approx(1.0)
    assert runner.step() == pytest.approx(1.05)
    assert runner.frame.time == pytest.approx(1.05)


def test_it_starts_pauses_and_stops(runner: bubblesim.Runner) -> None:
    runner.start()
    while runner.frame.time < 1:
        time.sleep(0)
    runner.pause()
    paused_at = runner.frame.time
    assert runner.state == RunState.PAUSED
    assert runner.step() > paused_at
    runner.stop()
    assert runner.state == RunState.STOPPED
    assert runner.frame.time == 0
    with pytest.raises(bubblesim.NotCarriedOut, match="start it first"):
        runner.step()


def test_a_call_uses_the_simulation_between_steps(runner: bubblesim.Runner) -> None:
    def drive(simulation: bubblesim.Simulation) -> float:
        simulation.object("/FrontMotor").target_velocity = 5.0
        return simulation.time

    assert runner.call(drive) == 0
    runner.step(40)
    assert runner.call(lambda simulation: simulation.object("/Tricycle").linear_velocity[0]) > 0.1


def test_a_call_raises_what_its_function_raises(runner: bubblesim.Runner) -> None:
    with pytest.raises(bubblesim.NoSuchObject, match="/None"):
        runner.call(lambda simulation: simulation.object("/None"))
    with pytest.raises(ZeroDivisionError):
        runner.call(lambda simulation: 1 / 0)


def test_a_function_that_the_runner_calls_cannot_wait_for_it(runner: bubblesim.Runner) -> None:
    with pytest.raises(RuntimeError, match="cannot wait"):
        runner.call(lambda simulation: runner.step())


def test_other_threads_are_refused_until_the_end() -> None:
    simulation = bubblesim.Simulation("tricycle")
    tricycle = simulation.object("/Tricycle")
    with bubblesim.Runner(simulation) as runner:
        for use in (lambda: simulation.time, lambda: simulation.step(), lambda: tricycle.position):
            with pytest.raises(RuntimeError, match="a Runner runs this simulation in another thread"):
                use()
        runner.step()
    assert simulation.time == pytest.approx(0.05)
    with pytest.raises(RuntimeError, match="does not run"):
        runner.step()


def run_program(code: str) -> "subprocess.CompletedProcess[str]":
    """Run a Python program of its own, which the core may end."""
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=False)


@pytest.mark.parametrize("second", ["second", "bubblesim.Runner(simulation)"], ids=["made before", "made later"])
def test_a_second_runner_of_a_simulation_is_refused(second: str) -> None:
    run = run_program(f"""
import bubblesim
simulation = bubblesim.Simulation("ball")
first, second = bubblesim.Runner(simulation), bubblesim.Runner(simulation)
with first:
    first.step()
    with {second}:
        print("both run")
""")
    assert (run.returncode, run.stdout) == (1, "")
    assert "ValueError: a Runner runs this simulation already, in thread " in run.stderr
    assert "close that Runner first" in run.stderr


def test_a_runner_that_is_dropped_while_it_runs_ends_its_thread() -> None:
    run = run_program("""
import bubblesim, math, time
simulation = bubblesim.Simulation("ball")
for _ in range(20):  # most of the times, the thread waits for Python at that moment
    runner = bubblesim.Runner(simulation, speed=math.inf)
    runner.add_gate(lambda: True, lambda: "")
    runner.__enter__()
    runner.start()
    time.sleep(0.01)
    del runner
print(simulation.time > 0)
""")
    assert (run.returncode, run.stdout, run.stderr) == (0, "True\n", "")


def test_what_has_no_lock_is_refused_in_other_threads(runner: bubblesim.Runner) -> None:
    uses: list[Callable[[], object]] = [
        lambda: runner.add_gate(lambda: True, lambda: ""),
        lambda: runner.remove_gate(1),
        lambda: runner.watch(0, lambda: False),
        runner.share_frames,
    ]
    for use in uses:
        with pytest.raises(RuntimeError, match="of a running Runner can be used in its own thread only"):
            use()
    assert runner.call(lambda _: runner.add_gate(lambda: True, lambda: "")) == 0
    runner.call(lambda _: runner.share_frames())


def test_a_frame_is_a_picture_of_one_time(runner: bubblesim.Runner) -> None:
    names = runner.call(lambda simulation: {thing.handle: thing.path for thing in simulation.objects})
    first = runner.frame
    assert first.poses.shape == (len(first.links), 7)
    assert first.poses.dtype == np.float32
    assert not first.poses.flags.writeable
    runner.call(lambda simulation: setattr(simulation.object("/FrontMotor"), "target_velocity", 5.0))
    before = first.poses.copy()
    runner.step(40)
    second = runner.frame
    row = [names[link] for link in second.links].index("/Tricycle/base_link")
    position = runner.call(lambda simulation: simulation.object("/base_link").position)
    assert second.poses[row, :3] == pytest.approx(position, abs=1e-6)
    assert np.linalg.norm(second.poses[row, :2] - first.poses[row, :2]) > 0.1
    assert (first.poses == before).all()
    motor = [names[joint] for joint, _ in second.axes].index("/Tricycle/FrontMotor")
    turned = runner.call(lambda simulation: simulation.object("/FrontMotor").joint_position)
    assert second.joint_positions[motor] == pytest.approx(turned, abs=1e-5)
    assert second.revision == first.revision


def test_threads_command_and_read_while_it_runs(runner: bubblesim.Runner) -> None:
    failures = []

    def use() -> None:
        try:
            last = 0.0
            for _ in range(50):
                runner.start()
                now = runner.call(lambda simulation: simulation.time)
                assert now >= last
                last = now
                assert np.isfinite(runner.frame.poses).all()
        except Exception as error:
            failures.append(error)

    threads = [threading.Thread(target=use) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures


def test_it_keeps_real_time() -> None:
    with bubblesim.Runner(bubblesim.Simulation("ball"), speed=2) as runner:
        begin = time.monotonic()
        runner.start()
        while runner.frame.time < 1:
            time.sleep(0.001)
        assert time.monotonic() - begin > 0.45


def test_a_speed_must_be_positive() -> None:
    with pytest.raises(ValueError, match="speed"):
        bubblesim.Runner(bubblesim.Simulation("ball"), speed=0)


def test_ctrl_c_ends_a_wait() -> None:
    code = (
        "import bubblesim, math\n"
        "with bubblesim.Runner(bubblesim.Simulation('ball'), speed=math.inf) as runner:\n"
        "    print('ready', flush=True)\n"
        "    runner.step(10**12)\n"
    )
    assert "KeyboardInterrupt" in errors_of_interrupted(code)
