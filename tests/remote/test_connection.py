# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim.connect."""

import subprocess
import sys

import numpy as np
import pytest
import zmq

import bubblesim
from remote_support import RemoteNode
from ros_support import DEADLINE, free_port


def test_bubblesim_connect_has_typed_results(node: RemoteNode) -> None:
    with bubblesim.connect(node.port) as simulator:
        sim = simulator.sim
        assert sim.getObjectPosition.__doc__ == "Return [x, y, z] in metres."
        car = sim.getObject("/Tricycle")
        sim.setStepping(True)
        sim.startSimulation()
        dummy = sim.createDummy(0.1)
        sim.setObjectPosition(dummy, np.array([1.0, 2.0, 3.0]))
        np.testing.assert_allclose(sim.getObjectPosition(dummy), [1, 2, 3])
        assert isinstance(sim.getObjectPosition(car), np.ndarray)
        assert sim.step() is None
        with pytest.raises(RuntimeError, match="did you mean /Tricycle"):
            sim.getObject("/Tricyle")
    other = node.sim()
    other.wait(0.5)  # the connection has ended its stepping


def test_a_connection_that_is_dropped_is_collected(node: RemoteNode) -> None:
    code = f"""
import gc, bubblesim
simulator = bubblesim.connect({node.port})
frames = simulator.frames()
next(frames)
del simulator, frames
gc.collect()
print('collected')
"""
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=DEADLINE, check=True)
    assert run.stdout == "collected\n"


def test_calls_after_the_end_fail(node: RemoteNode) -> None:
    simulator = bubblesim.connect(node.port)
    frames = simulator.frames()
    next(frames)
    simulator.close()
    with pytest.raises(zmq.ZMQError):
        simulator.sim.getSimulationTime()
    with pytest.raises(zmq.ZMQError):
        next(frames)


def test_bubblesim_connect_reports_that_no_server_answers() -> None:
    port = free_port()
    with pytest.raises(TimeoutError, match=rf"no answer from 127.0.0.1:{port} in 0.2 s: .* --remote={port}"):
        bubblesim.connect(port, timeout=0.2)


def test_bubblesim_connect_reports_what_it_waits_for(caplog: pytest.LogCaptureFixture) -> None:
    port = free_port()
    with pytest.raises(TimeoutError):
        bubblesim.connect(port, timeout=2.1)
    assert (
        f"no answer from 127.0.0.1:{port} yet, waiting up to 2.1 s: start a simulator with --remote={port}"
        in caplog.text
    )
