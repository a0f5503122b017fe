# SPDX-License-Identifier: BSD-3-Clause
"""The begin and the end of the door."""

import time
from pathlib import Path

import cbor2

from door_support import Door
from node_support import run_sim


def test_the_end_of_the_node_is_reported_to_those_who_wait(tmp_path: Path) -> None:
    with Door(tmp_path) as door:
        one, two = door.sim(), door.sim()
        one.startSimulation()
        one.pauseSimulation()
        raw = door.raw()
        for name in ("sim.getSimulationTime", "sim.step"):
            raw.send(cbor2.dumps({"func": name, "args": [], "uuid": "waits"}))
            assert name == "sim.step" or cbor2.loads(raw.recv()) == {"ret": [one.getSimulationTime()]}
        time.sleep(0.5)  # the sockets are not ordered: the step of the one may arrive after the end of the other
        assert two.getSimulationState() == two.simulation_paused
        two.quitSimulator()
        assert "the simulator has ended" in cbor2.loads(raw.recv())["err"]
        raw.close()
        assert door.process.wait(10) == 0


def test_an_address_in_use_is_an_error(door: Door) -> None:
    run = run_sim("ball", "--no-ros", f"--remote={door.port}")
    assert run.returncode == 2
    assert f"cannot listen on 127.0.0.1:{door.port}: Address already in use; another port: --remote=PORT" in run.stderr


def test_an_open_address_is_warned_of(tmp_path: Path) -> None:
    with Door(tmp_path, "--remote-address", "0.0.0.0") as door:
        assert "warning: all who reach 0.0.0.0 can control the simulation" in door.output
