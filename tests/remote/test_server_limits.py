# SPDX-License-Identifier: BSD-3-Clause
"""Strange messages, floods and many clients."""

import time
from typing import Any

import cbor2
import pytest
import zmq

from remote_support import RemoteNode
from ros_support import DEADLINE


def test_strange_messages_get_an_error(node: RemoteNode) -> None:
    socket = node.raw()

    def answer(data: bytes) -> Any:
        socket.send(data)
        return cbor2.loads(socket.recv())

    assert "not a CBOR map" in answer(b"\xff")["err"]
    assert "the data ends early" in answer(b"\x9b" + b"\xff" * 8)["err"]
    assert "'func'" in answer(cbor2.dumps([]))["err"]
    assert answer(cbor2.dumps({"func": "sim.getSimulationTime", "args": []}))["success"] is False
    assert "no callback" in answer(cbor2.dumps({"func": "_*executed*_", "args": [], "uuid": "u"}))["err"]
    assert answer(cbor2.dumps({"func": "_*end*_", "args": [], "uuid": "u"})) == {}
    large = cbor2.dumps({"func": "sim.setStringSignal", "args": ["big", bytes(60_000_000)], "uuid": "u"})
    assert answer(large) == {"ret": []}
    nested: Any = 1
    for _ in range(100):
        nested = [nested]
    assert "nested" in answer(cbor2.dumps({"func": "sim.packTable", "args": [nested], "uuid": "u"}))["err"]
    socket.close()
    parts = node.raw(zmq.DEALER)
    for message in ([b"x"], [b"", b"a", b"b"], [b"\x00" * 10, b""], [b""]):
        parts.send_multipart(message)
    too_large = node.raw()
    too_large.send(bytes(70_000_000))
    assert node.sim().getSimulationState() == 0
    parts.close()
    too_large.close()


def test_a_flood_stops_neither_steps_nor_other_clients(node: RemoteNode) -> None:
    sim = node.sim()
    sim.startSimulation()
    flood = node.raw(zmq.DEALER)
    request = cbor2.dumps({"func": "sim.getSimulationTime", "args": [], "uuid": "flood"})
    sent = 0
    begin = now = sim.getSimulationTime()
    start = looked = time.monotonic()
    # For 2 s, and on a busy machine for as long as the steps take.
    while (passed := time.monotonic() - start) < 2.0 or (now <= begin + 1.0 and passed < DEADLINE):
        try:
            flood.send_multipart([b"", request], zmq.NOBLOCK)
            sent += 1
        except zmq.Again:
            pass
        if time.monotonic() > looked + 0.1:
            now, looked = sim.getSimulationTime(), time.monotonic()
    assert sent > 1000
    assert now > begin + 1.0
    flood.close()


def test_many_idle_clients_do_no_harm(node: RemoteNode) -> None:
    sim = node.sim()
    idle = []
    for number in range(200):
        socket = node.raw()
        socket.send(cbor2.dumps({"func": "sim.getSimulationTime", "args": [], "uuid": f"idle {number}"}))
        assert cbor2.loads(socket.recv()) == {"ret": [0.0]}
        idle.append(socket)
    sim.setStepping(True)
    sim.startSimulation()
    for _ in range(50):
        sim.step()
    assert sim.getSimulationTime() == pytest.approx(2.5)
    for socket in idle:
        socket.close()


@pytest.mark.parametrize("part", [11, pytest.param(1, marks=pytest.mark.long)])
def test_no_function_falls_over_odd_arguments(node: RemoteNode, part: int) -> None:
    """Each function gets each odd argument, and one of `part` pairs of them; the next function others."""
    odd = [None, -5, 2**64 - 1, float("nan"), "text", b"bytes", [], [1, 2, 3], {"a": 1}, "f@func", "_*NIL*_"]
    others = {"quitSimulator", "wait", "step", "switchThread", "stopSimulation", "pauseSimulation", "closeScene"}
    socket = node.raw()

    def call(function: str, *arguments: object) -> Any:
        socket.send(cbor2.dumps({"func": function, "args": list(arguments), "uuid": "odd"}))
        return cbor2.loads(socket.recv())

    (known,) = call("zmqRemoteApi.info", "sim")["ret"]
    names = sorted(name for name, entry in known.items() if "func" in entry and name not in others)
    assert len(names) > 120
    pairs = [(a, b) for a in odd[:6] for b in odd]
    for number, name in enumerate(names):
        for arguments in ((), *((a,) for a in odd), *pairs[number % part :: part]):
            reply = call(f"sim.{name}", *arguments)
            assert reply.keys() in ({"ret"}, {"err"}), (name, arguments, reply)
            assert "incompatible function arguments" not in reply.get("err", ""), (name, arguments, reply)
    assert call("sim.stopSimulation").keys() <= {"ret"}
    assert call("sim.getSimulationState") == {"ret": [0]}
    socket.close()
