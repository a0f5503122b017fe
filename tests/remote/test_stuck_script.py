# SPDX-License-Identifier: BSD-3-Clause
"""A script that does not return keeps the thread that serves remote clients, but not their stop."""

import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cbor2
import pytest
import zmq

import bubblesim
from bubblesim.remote import token
from node_support import write
from remote_support import RemoteNode, refusal
from ros_support import DEADLINE

ENDLESS = {
    "script.py": "def sysCall_init(): pass\ndef sysCall_actuation():\n    while True: pass\n",
    "calls.py": "def sysCall_init(): pass\ndef sysCall_actuation():\n    while True: sim.getSimulationTime()\n",
    "script.lua": "function sysCall_init() end\nfunction sysCall_actuation() while true do end end\n",
}
WITHIN = 2.0  # s


class StuckNode(RemoteNode):
    """A node whose script runs and does not return."""

    def __init__(self, folder: Path, *options: object, name: str = "script.py") -> None:
        script = write(folder / name, ENDLESS[name])
        super().__init__(folder, "--child-script", f"/Ball={script}", *options, scene="ball")


def stuck_again(node: RemoteNode, start: Callable[[], object]) -> None:
    """Start the simulation, and wait until the script is reported."""
    before = node.output.count("has not returned from sysCall_actuation")
    start()
    node.wait_for_output("has not returned from sysCall_actuation", count=before + 1)


def duration(call: Callable[[], object]) -> float:
    begin = time.monotonic()
    call()
    return time.monotonic() - begin


@pytest.mark.parametrize("name", ENDLESS)
def test_a_stop_of_coppeliasims_client_reaches_it(tmp_path: Path, name: str) -> None:
    with StuckNode(tmp_path, name=name) as node:
        sim = node.sim()
        stuck_again(node, sim.startSimulation)
        times = [duration(sim.stopSimulation)]
        assert sim.getSimulationState() == sim.simulation_stopped
        stuck_again(node, sim.startSimulation)
        times.append(duration(sim.stopSimulation))
        assert min(times) < WITHIN  # of two, because the machine may be busy
        assert node.output.count("was interrupted in sysCall_actuation") == 2


def test_a_client_that_connects_meanwhile_can_stop_it(tmp_path: Path) -> None:
    with StuckNode(tmp_path) as node:
        stuck_again(node, node.sim().startSimulation)
        late = node.sim()  # asks for the functions of sim
        late.stopSimulation()
        assert late.getSimulationState() == late.simulation_stopped
        late.setStepping(True)  # as a client that is known
        assert late.setStepping(True) == 1


def _request(node: RemoteNode, function: str, *arguments: Any) -> "zmq.Socket[bytes]":
    socket = node.raw()
    socket.send(cbor2.dumps({"func": function, "args": list(arguments), "uuid": f"{id(socket)}"}))
    time.sleep(0.05)  # for the order between connections
    return socket


def _result(socket: "zmq.Socket[bytes]") -> Any:
    reply = cbor2.loads(socket.recv())
    assert "err" not in reply, reply
    return reply["ret"]


def test_what_is_no_stop_is_answered_later_in_its_order(tmp_path: Path) -> None:
    with StuckNode(tmp_path) as node:
        first = node.sim()
        stuck_again(node, first.startSimulation)
        before = [_request(node, "sim.createDummy", 0.01) for _ in range(5)]
        time.sleep(1.2)  # the watchdog looks twice: some are received ahead
        assert not any(socket.poll(0) for socket in before)
        stop = _request(node, "sim.stopSimulation")
        after = [_request(node, "sim.createDummy", 0.01) for _ in range(5)]
        handles = [_result(socket)[0] for socket in [*before, *after]]
        _result(stop)
        assert handles == sorted(handles)
        assert len(set(handles)) == 10


def test_a_stop_behind_a_call_of_the_same_client_waits_for_it(tmp_path: Path) -> None:
    with StuckNode(tmp_path) as node:
        stuck_again(node, node.sim().startSimulation)
        socket = node.raw(zmq.DEALER)
        for function in ("sim.getSimulationTime", "sim.stopSimulation"):
            socket.send_multipart([b"", cbor2.dumps({"func": function, "uuid": "dealer"})])
        assert not socket.poll(2500)
        assert "was interrupted" not in node.output
        node.sim().stopSimulation()
        assert [list(cbor2.loads(socket.recv_multipart()[1])) for _ in range(2)] == [["ret"], ["ret"]]


def test_a_stop_without_the_token_interrupts_nothing(tmp_path: Path) -> None:
    secret = tmp_path / "token"
    with StuckNode(tmp_path, f"--remote-token={secret}") as node:
        owner = bubblesim.connect(node.port, token=secret, timeout=DEADLINE)
        stuck_again(node, owner.sim.startSimulation)
        other = _request(node, "sim.stopSimulation")
        threading.Event().wait(1.5)
        assert "was interrupted" not in node.output
        late = node.client()
        late.call("bubblesim.token", [token.read(secret)])
        sim = late.require("sim")
        sim.stopSimulation()
        assert "was interrupted" in node.output
        assert "this node wants a token" in cbor2.loads(other.recv())["err"]
        assert "this node wants a token" in refusal(node.client().require, "sim")
        owner.close()


def test_a_script_that_another_client_calls_is_interrupted_for_a_stop(tmp_path: Path) -> None:
    script = write(tmp_path / "called.py", "def sysCall_init(): pass\ndef spin():\n    while True: pass\n")
    with RemoteNode(tmp_path, "--child-script", f"/Ball={script}", scene="ball") as node:
        sim = node.sim()
        sim.startSimulation()
        handle = sim.getScript(sim.scripttype_childscript, sim.getObject("/Ball"))
        caller = _request(node, "sim.callScriptFunction", "spin", handle)
        node.wait_for_output("has not returned from")
        sim.stopSimulation()
        assert "interrupted" in cbor2.loads(caller.recv())["err"]
