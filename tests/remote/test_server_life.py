# SPDX-License-Identifier: BSD-3-Clause
"""The beginning and the end of the remote API server."""

from pathlib import Path

import cbor2
import zmq

from node_support import run_sim
from remote_support import RemoteNode
from ros_support import DEADLINE, free_port, wait_until


def test_the_end_of_the_node_is_reported_to_those_who_wait(tmp_path: Path) -> None:
    with RemoteNode(tmp_path) as node:
        one, two = node.sim(), node.sim()
        one.startSimulation()
        one.pauseSimulation()
        raw = node.raw(zmq.DEALER)  # it may send another request before the reply
        for name in ("sim.getSimulationTime", "sim.step", "sim.getSimulationTime"):
            raw.send_multipart([b"", cbor2.dumps({"func": name, "args": [], "uuid": "waits"})])
        replies = [cbor2.loads(raw.recv_multipart()[-1]) for _ in range(2)]
        # The sockets are not ordered: without the second reply the step might arrive after the end.
        assert replies[0] == {"ret": [one.getSimulationTime()]}
        assert "the previous call on this socket is not answered yet" in replies[1]["err"]
        assert two.getSimulationState() == two.simulation_paused
        two.quitSimulator()
        assert "the simulator has ended" in cbor2.loads(raw.recv_multipart()[-1])["err"]
        raw.close()
        assert node.process.wait(DEADLINE) == 0


def test_an_address_in_use_is_an_error(node: RemoteNode) -> None:
    run = run_sim("ball", "--no-ros", f"--remote={node.port}")
    assert run.returncode == 2
    assert run.stderr.splitlines() == [
        f"error: cannot listen on 127.0.0.1:{node.port}: Address already in use (sim, process {node.process.pid}); "
        "another port: --remote=PORT"
    ]


def test_a_simulation_that_waits_for_a_client_is_announced(tmp_path: Path) -> None:
    waits = "info: the simulation is stopped until a remote client or ~unpause starts it; --start begins at once\n"
    with RemoteNode(tmp_path, "--until", "1") as node:
        wait_until(lambda: waits in node.output, "the line")
    started = run_sim("ball", "--no-ros", f"--remote={free_port()}", "--start", "--until", "0.1", "--speed", "max")
    assert (started.returncode, waits in started.stderr) == (0, False)


def test_an_open_address_is_warned_of(tmp_path: Path) -> None:
    with RemoteNode(tmp_path, "--remote-address", "0.0.0.0") as node:
        assert "warning: all who reach 0.0.0.0 can control the simulation" in node.output
