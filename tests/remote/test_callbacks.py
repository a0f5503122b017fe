# SPDX-License-Identifier: BSD-3-Clause
"""Functions of clients that the simulator calls."""

from pathlib import Path

import pytest

from node_support import write
from remote_support import RemoteNode, refusal


def test_callbacks_run_in_the_client(node: RemoteNode) -> None:
    sim = node.sim()
    calls = []

    def add(a: int, b: int) -> int:
        calls.append((a, b))
        return a + b + sim.getSimulationState()

    assert sim.testCB(21, add, 42) == 63
    assert len(calls) == 100
    assert "expected a function" in refusal(sim.testCB, 1, 5, 2)


SCRIPT = """
    def sysCall_init():
        self.notify = None
    def sysCall_sensing():
        if self.notify:
            self.notify(sim.getSimulationTime(), b'\\x00\\xff')
    def listen(callback):
        self.notify = callback
    def add(a, b):
        return a + b
    def fail():
        return 1 / 0
"""


def test_scripts_are_called_and_call_back(tmp_path: Path) -> None:
    script = write(tmp_path / "script.py", SCRIPT)
    with RemoteNode(tmp_path, "--child-script", f"/Ball={script}", "--speed", "max", scene="ball") as node:
        sim = node.sim()
        ball = sim.getScript(sim.scripttype_simulation, "/Ball")
        assert "the simulation is stopped" in refusal(sim.callScriptFunction, "add", ball, 1, 2)
        sim.setStepping(True)
        sim.startSimulation()
        sim.step()
        assert sim.callScriptFunction("add", ball, 1, 2) == 3
        assert sim.getScriptFunctions(ball).add(3, 4) == 7
        assert "ZeroDivisionError" in refusal(sim.callScriptFunction, "fail", ball)
        received = []
        sim.callScriptFunction("listen", ball, lambda *values: received.append(values))
        for _ in range(5):
            sim.step()
        sim.getSimulationTime()
        assert [b for _, b in received] == [b"\x00\xff"] * 5
        assert [t for t, _ in received] == pytest.approx([0.05 * i for i in range(1, 6)])


LARGE = """
    def sysCall_init():
        self.notify = None
    def sysCall_sensing():
        if self.notify:
            self.notify(sim.getSimulationTime(), bytes(1_000_000))
    def listen(callback):
        self.notify = callback
"""


def test_of_the_calls_that_wait_for_a_client_the_last_16_mebibytes_are_kept(tmp_path: Path) -> None:
    script = write(tmp_path / "script.py", LARGE)
    with RemoteNode(tmp_path, "--child-script", f"/Ball={script}", "--speed", "max", scene="ball") as node:
        silent, sim = node.sim(), node.sim()
        ball = sim.getScript(sim.scripttype_simulation, "/Ball")
        sim.setStepping(True)
        sim.startSimulation()
        sim.step()
        received = []
        silent.callScriptFunction("listen", ball, lambda time, _: received.append(time))
        for _ in range(100):
            sim.step()
        silent.getSimulationTime()
        assert received == pytest.approx([0.05 * i for i in range(85, 101)])
