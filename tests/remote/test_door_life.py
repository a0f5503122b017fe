# SPDX-License-Identifier: BSD-3-Clause
"""The begin and the end of the door."""

from pathlib import Path

import cbor2
import zmq

from door_support import Door
from node_support import run_sim
from ros_support import DEADLINE


def test_the_end_of_the_node_is_reported_to_those_who_wait(tmp_path: Path) -> None:
    with Door(tmp_path) as door:
        one, two = door.sim(), door.sim()
        one.startSimulation()
        one.pauseSimulation()
        raw = door.raw(zmq.DEALER)  # it may send another request before the reply
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
        assert door.process.wait(DEADLINE) == 0


def test_an_address_in_use_is_an_error(door: Door) -> None:
    run = run_sim("ball", "--no-ros", f"--remote={door.port}")
    assert run.returncode == 2
    assert f"cannot listen on 127.0.0.1:{door.port}: Address already in use; another port: --remote=PORT" in run.stderr


def test_an_open_address_is_warned_of(tmp_path: Path) -> None:
    with Door(tmp_path, "--remote-address", "0.0.0.0") as door:
        assert "warning: all who reach 0.0.0.0 can control the simulation" in door.output
