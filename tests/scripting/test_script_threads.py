# SPDX-License-Identifier: BSD-3-Clause
"""sysCall_thread: when it runs, what it can wait for, and how it ends."""

import itertools
import signal
import socket
import time
from pathlib import Path

import pytest

from bubblesim.scripting.threads.script_thread import ScriptThread
from node_support import Node, clean_environment, run_script, write


def lines(folder: Path, code: str, until: float = 0.2) -> list[str]:
    run = run_script(folder, code, "--strict", until=until)
    assert (run.returncode, run.stderr) == (0, "")
    return run.stdout.splitlines()


def test_with_stepping_it_runs_once_a_pass_before_the_actuation(tmp_path: Path) -> None:
    code = """
        def report(what): print(what, f'{sim.getSimulationTime():.2f}')
        def sysCall_init(): report('init')
        def sysCall_thread():
            assert sim.setStepping(True) == 0
            report('begins')
            sim.step()
            report('thread')
            sim.switchThread()
            report('ends')
        def sysCall_actuation(): report('actuation')
        def sysCall_cleanup(): report('cleanup')
    """
    assert lines(tmp_path, code) == [
        *("init 0.00", "begins 0.00", "actuation 0.00", "thread 0.05", "actuation 0.05"),
        *("ends 0.10", "actuation 0.10", "actuation 0.15", "cleanup 0.20"),
    ]


def test_a_pass_waits_for_a_thread_that_steps_however_long_it_computes(tmp_path: Path) -> None:
    code = """
        import time
        def sysCall_thread():
            sim.setStepping(True)
            end = time.perf_counter() + 0.2
            while time.perf_counter() < end: pass
            print('computed', sim.getSimulationTime())
    """
    assert lines(tmp_path, code) == ["computed 0.0"]


def test_without_stepping_a_thread_that_never_waits_stops_nobody(tmp_path: Path) -> None:
    code = """
        def sysCall_init(): self.steps = 0
        def sysCall_thread():
            times = set()
            while not sim.getThreadExitRequest():
                times.add(sim.getSimulationTime())
            print('ends', len(times) > 3)
        def sysCall_sensing(): self.steps += 1
        def sysCall_cleanup(): print(self.steps)
    """
    assert lines(tmp_path, code, until=1.0) == ["ends True", "20"]


@pytest.mark.parametrize("call", ["sim.setAutoYieldDelay(0.1)", "sim.setThreadSwitchTiming(100)"])
def test_a_script_sets_how_long_its_turns_last(tmp_path: Path, call: str) -> None:
    code = f"""
        import time
        def sysCall_thread():
            {call}
            begin, step = time.thread_time(), sim.getSimulationTime()
            while sim.getSimulationTime() == step: pass
            print(time.thread_time() - begin > 0.09, sim.getThreadSwitchTiming())
            sim.setAutoYieldDelay(-1)
    """
    run = run_script(tmp_path, code)
    assert run.stdout == "True 100.0\n"
    assert "ValueError: a turn of -1 s: it must be 0 or more" in run.stderr


@pytest.mark.parametrize("stepping", [True, False], ids=["stepping", "automatic"])
@pytest.mark.parametrize(
    "wait",
    ["server.accept()", "pair[0].recv(10)", "datagrams.recvfrom(10)", "time.sleep(1000)", "sleep(1000)"],
    ids=["accept", "recv", "recvfrom", "time.sleep", "sleep"],
)
def test_one_that_waits_stops_nobody_and_ends_with_the_simulation(tmp_path: Path, wait: str, stepping: bool) -> None:
    code = f"""
        import socket, time
        from time import sleep
        def sysCall_thread():
            sim.setStepping(True)
            server = socket.create_server(('127.0.0.1', 0))
            pair = socket.socketpair()
            datagrams = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
            datagrams.bind(('127.0.0.1', 0))
            print('waits')
            sim.setStepping({stepping})
            while True: {wait}
        def sysCall_actuation(): print('actuation')
        def sysCall_cleanup(): print('cleanup')
    """
    assert lines(tmp_path, code) == ["waits", *["actuation"] * 4, "cleanup"]


def test_a_thread_that_steps_sees_that_it_should_end(tmp_path: Path) -> None:
    code = """
        def sysCall_thread():
            sim.setThreadAutomaticSwitch(False)
            while not sim.getThreadExitRequest(): sim.step()
            print('ends', sim.getSimulationStopping(), f'{sim.getSimulationTime():.2f}')
        def sysCall_cleanup(): print('cleanup')
    """
    assert lines(tmp_path, code) == ["ends True 0.20", "cleanup"]


@pytest.mark.parametrize("loop", ["sim.step()", "pass", "sim.getSimulationTime()", "sim.wait(0.01)"])
def test_one_that_does_not_look_is_ended(tmp_path: Path, loop: str) -> None:
    code = f"""
        def sysCall_thread():
            while True:
                {loop}
        def sysCall_cleanup(): print('cleanup')
    """
    assert lines(tmp_path, code) == ["cleanup"]


def test_wait_takes_simulation_time_or_that_of_the_machine(tmp_path: Path) -> None:
    code = """
        import time
        def sysCall_thread():
            sim.setStepping(True)
            sim.wait(0.15)
            print(f'{sim.getSimulationTime():.2f}', f'{sim.wait(0.12):.2f}', f'{sim.getSimulationTime():.2f}')
            before = time.perf_counter()
            sim.wait(0.02, False)
            print(time.perf_counter() - before >= 0.02)
            sim.quitSimulator()
    """
    assert lines(tmp_path, code, until=1e6) == [
        "0.15 -0.03 0.30",
        "True",
    ]


def test_locks_and_stepping_nest(tmp_path: Path) -> None:
    code = """
        def sysCall_thread():
            levels = [sim.setStepping(True), sim.setStepping(True)]
            sim.acquireLock()
            levels += [sim.setStepping(False)]
            sim.releaseLock()
            print(levels + [sim.setStepping(False), sim.setStepping(False)])
    """
    assert lines(tmp_path, code) == ["[0, 1, 3, 1, 0]"]


def test_an_error_in_the_thread_ends_the_script_and_names_the_line(tmp_path: Path) -> None:
    code = "def sysCall_thread():\n    sim.setStepping(True)\n    sim.step()\n    1 / 0\n"
    run = run_script(tmp_path, code, "--strict", until=1e6)
    assert run.returncode == 3
    assert f"child script of /Ball failed in sysCall_thread ({tmp_path}/script.py:4) and is disabled" in run.stderr
    assert "ZeroDivisionError" in run.stderr
    assert "script_thread.py" not in run.stderr


def test_a_callback_cannot_step(tmp_path: Path) -> None:
    run = run_script(tmp_path, "def sysCall_init(): sim.step()\n", "--strict")
    assert run.returncode == 3
    assert "sim.step is only allowed in sysCall_thread" in run.stderr


def test_a_thread_that_never_steps_in_stepping_mode_is_broken_off_by_a_signal(tmp_path: Path) -> None:
    code = """
        def sysCall_thread():
            sim.setStepping(True)
            print('begun')
            while True: pass
        def sysCall_cleanup(): print('cleanup')
    """
    script = write(tmp_path / "script.py", code)
    options = ["ball", "--no-ros", "--child-script", f"/Ball={script}"]
    with Node(clean_environment(), tmp_path / "log", *options) as node:
        node.wait_for_output("begun")
        assert node.end(signal.SIGTERM) == 0
        assert "was interrupted in sysCall_thread" in node.output
        assert node.output.endswith("cleanup\n")


def test_a_thread_is_woken_at_its_end_even_if_the_machine_stands_still_meanwhile(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    waits, _other = socket.socketpair()
    thread = ScriptThread("waits", lambda: waits.recv(1))
    thread.run_turn()
    hours = itertools.count()
    monkeypatch.setattr(time, "monotonic", lambda: 3600.0 * next(hours))
    assert thread.end(lambda: waits.shutdown(socket.SHUT_RDWR))
