# SPDX-License-Identifier: BSD-3-Clause
"""Stepping mode, waiting, and clients that disappear while they step."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import cbor2
import pytest

from node_support import run_sim, write
from process_support import open_files
from remote_support import RemoteNode
from ros_support import DEADLINE, wait_until


def test_two_clients_step_together(node: RemoteNode) -> None:
    one, two, watching = node.sim(), node.sim(), node.sim()
    assert (one.setStepping(True), one.setStepping(True), one.setStepping(False)) == (0, 1, 2)
    two.setStepping(True)
    one.startSimulation()
    assert watching.getSimulationTime() == 0
    one.client.call("sim.step", [False])  # alone it does nothing
    for _ in range(3):
        assert watching.getSimulationTime() == 0
    two.step()
    assert watching.getSimulationTime() == pytest.approx(0.05)
    two.client.call("sim.step", [False])
    one.step()
    assert watching.getSimulationTime() == pytest.approx(0.1)
    two.setStepping(False)
    one.step()
    assert watching.getSimulationTime() == pytest.approx(0.15)
    watching.stopSimulation()
    watching.startSimulation()  # the stop has ended the stepping
    watching.wait(1.0)


def test_wait_runs_the_steps_of_a_stepping_client(node: RemoteNode) -> None:
    sim = node.sim()
    sim.setStepping(True)
    sim.startSimulation()
    sim.wait(0.5)
    assert sim.getSimulationTime() == pytest.approx(0.5)
    begin = time.monotonic()
    sim.wait(0.2, False)
    assert time.monotonic() - begin >= 0.2
    assert sim.getSimulationTime() == pytest.approx(0.5)


KILLED = """
import sys, time
from coppeliasim_zmqremoteapi_client import RemoteAPIClient
port, state, moment = sys.argv[1:]
sim = RemoteAPIClient(port=int(port)).require('sim')
if state != 'running':
    sim.setStepping(True)
if state != 'stopped':
    sim.startSimulation()
if state == 'paused':
    sim.pauseSimulation()
big = bytes(40_000_000)
MOMENTS = {
    'idle': lambda: time.sleep(1000),
    'call': lambda: sim.getObjectPosition(sim.getObject('/Tricycle')),
    'large call': lambda: sim.setStringSignal('big', big),
    'step': lambda: sim.step(),
    'wait': lambda: sim.wait(1000.0, state != 'stopped'),
    'callback': lambda: sim.testCB(1, lambda a, b: time.sleep(1000), 2),
}
print('ready', flush=True)
while True:
    MOMENTS[moment]()
"""
MOMENTS = ["idle", "call", "large call", "step", "wait", "callback"]


@pytest.mark.parametrize("state", ["stopped", "paused", "running", "stepping"])
def test_a_client_killed_at_any_moment_releases_the_simulation(node: RemoteNode, tmp_path: Path, state: str) -> None:
    program = write(tmp_path / "client.py", KILLED)
    sim = node.sim()
    before = open_files(node.process.pid)
    for number, moment in enumerate(MOMENTS):
        command = [sys.executable, str(program), str(node.port), state, moment]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
            assert process.stdout
            assert process.stdout.readline() == "ready\n"
            time.sleep((0.0, 0.003, 0.01, 0.05)[number % 4])
            os.kill(process.pid, signal.SIGKILL)
        expected = {"stopped": sim.simulation_stopped, "paused": sim.simulation_paused}
        assert sim.getSimulationState() == expected.get(state, sim.simulation_advancing_running), moment
        sim.startSimulation()
        then = sim.getSimulationTime()
        wait_until(lambda then=then: sim.getSimulationTime() > then + 0.2, f"the simulation to run on after a {moment}")
        sim.stopSimulation()
    wait_until(lambda: open_files(node.process.pid) <= before, "the end of the connections")


def test_a_client_that_is_silent_for_its_timeout_is_released(node: RemoteNode) -> None:
    sim = node.sim()
    silent = node.raw()
    begin = time.monotonic()
    for message in (
        {"func": "sim.setStepping", "args": [True], "uuid": "silent", "ver": 2, "timeout": 1},
        {"func": "sim.startSimulation", "args": [], "uuid": "silent"},
    ):
        silent.send(cbor2.dumps(message))
        assert "ret" in cbor2.loads(silent.recv())
    # A machine that is busy for longer than the timeout releases it before.
    assert sim.getSimulationTime() == 0 or time.monotonic() - begin > 1
    wait_until(lambda: sim.getSimulationTime() > 0, "the release")
    assert "is silent for 1 s and was released" in node.output
    silent.close()


def test_a_silent_client_changes_nothing(tmp_path: Path) -> None:
    options = ["--no-ros", "--speed", "max", "--until", 3, "--state-hash", "--seed", 5]
    alone = run_sim("tricycle", *options).stdout.split()[-1]
    with RemoteNode(tmp_path, "--speed", 2, *options[3:]) as node:
        sim = node.sim()
        sim.getObject("/Tricycle")
        sim.startSimulation()  # not before: the run is short
        node.process.wait(3 * DEADLINE)
        assert node.output.split()[-1] == alone
