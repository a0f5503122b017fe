# SPDX-License-Identifier: BSD-3-Clause
"""No message of a client ends, blocks or fills the server of the others."""

import random
import socket
import struct
import time
from pathlib import Path
from typing import Any

import cbor2
import pytest
import zmq

import bubblesim
from node_support import write
from process_support import status
from remote_support import RemoteNode, refusal
from ros_support import DEADLINE, wait_until

ZMTP_1 = b"\x01\x00"  # greeting: no identity
ZMTP_2 = b"\xff" + bytes(8) + b"\x7f\x01\x03" + b"\x00\x00"  # signature, revision 1, REQ, no identity


def connected(node: RemoteNode) -> socket.socket:
    return socket.create_connection(("127.0.0.1", node.port), DEADLINE)


def call(client: "zmq.Socket[bytes]", function: str, *arguments: object, uuid: str = "hostile") -> Any:
    """Return the reply to a request."""
    client.send(cbor2.dumps({"func": function, "args": list(arguments), "uuid": uuid}))
    return cbor2.loads(client.recv())


def read_until(peer: socket.socket, text: bytes) -> None:
    read = b""
    while text not in read:
        part = peer.recv(4096)
        assert part, read
        read += part


@pytest.mark.parametrize(
    "message",
    [
        ZMTP_1 + b"\x01\x01" + b"\x04\x00abc",  # 9 bytes: an empty part, then three bytes
        ZMTP_2 + b"\x01\x00" + b"\x00\x03abc",
    ],
)
def test_a_client_that_is_too_old_gets_an_error(node: RemoteNode, message: bytes) -> None:
    with connected(node) as old:
        old.sendall(message)
        read_until(old, b"before 3.0: use libzmq 4")
    assert node.sim().getSimulationState() == 0
    assert "error" not in node.output


def test_random_bytes_end_nothing(node: RemoteNode) -> None:
    numbers = random.Random(1)
    for _ in range(200):
        with connected(node) as peer:
            peer.sendall(numbers.choice([b"", ZMTP_1, ZMTP_2]) + numbers.randbytes(100))
    assert node.sim().getSimulationState() == 0


def test_a_message_of_very_many_parts_is_discarded_in_between(node: RemoteNode) -> None:
    sim = node.sim()
    peer = node.raw(zmq.DEALER)
    peer.send_multipart([b""] * 200_000, copy=True)
    assert "expected a request of one part" in cbor2.loads(peer.recv_multipart()[-1])["err"]
    peer.send_multipart([b"", cbor2.dumps({"func": "sim.getSimulationTime", "uuid": "parts"})])
    assert cbor2.loads(peer.recv_multipart()[-1]) == {"ret": [0.0]}
    assert sim.getSimulationState() == 0
    peer.close()


def test_costly_messages_are_refused_at_once(node: RemoteNode) -> None:
    sim = node.sim()
    begin = b"\xa3\x64func\x67sim.any\x64uuid\x61u\x64args\x81"
    costly = {
        # 150,000 keys in a map. Such integers can be chosen so that all of them collide.
        "more than 1,000 keys": b"\xba"
        + struct.pack(">I", 150_000)
        + b"".join(b"\x1a%b\x00" % struct.pack(">I", i) for i in range(150_000)),
        "more than 4,096 entries": b"\xba"
        + struct.pack(">I", 150_000)
        + b"".join(b"\x64%04x\x00" % (i % 65536) for i in range(150_000)),
        "more than 200,000 values": b"\x9a" + struct.pack(">I", 3_900_000) + b"\x00" * 3_900_000,
        "more than 4 MiB of strings": b"\x7a" + struct.pack(">I", 16_000_000) + "ä".encode() * 8_000_000,
    }
    for reason, argument in costly.items():
        peer = node.raw()
        peer.send(begin + argument)
        assert reason in cbor2.loads(peer.recv())["err"]
        peer.close()
    assert sim.getSimulationState() == 0


def test_large_lists_of_real_clients_are_accepted(node: RemoteNode) -> None:
    sim = node.sim()
    points = [0.5 * i for i in range(3 * 66_000)]
    assert len(sim.packTable(points)) > len(points)
    assert sim.unpackTable(sim.packTable({1: "one", 2: [2.0]})) == {1: "one", 2: [2.0]}
    image = bytes(1920 * 1080 * 3)
    sim.setStringSignal("image", image)
    assert sim.getStringSignal("image") == image


def test_a_packed_table_has_the_limits_of_a_message(node: RemoteNode) -> None:
    peer = node.raw()
    packed = cbor2.dumps(dict.fromkeys(range(5000), 0))
    assert "more than 1,000 keys" in call(peer, "sim.unpackTable", packed)["err"]
    assert "at most 1000000" in call(peer, "sim.unpackUInt8Table", bytes(2_000_000))["err"]
    peer.close()


def test_signals_and_custom_data_have_a_limit(node: RemoteNode) -> None:
    sim = node.sim()
    sim.setStringSignal("a", bytes(60_000_000))
    sim.setStringSignal("b", bytes(60_000_000))
    for _ in range(3):  # values that are replaced need no room
        sim.setStringSignal("b", bytes(60_000_000))
    why = refusal(sim.setStringSignal, "c", bytes(60_000_000))
    assert "the signals of the scene would have more than 128 MiB" in why
    assert sim.getStringSignal("c") is None
    sim.clearStringSignal("a")
    sim.setStringSignal("c", bytes(60_000_000))
    sim.writeCustomStringData(sim.handle_scene, "a", bytes(60_000_000))
    sim.writeCustomStringData(sim.handle_scene, "b", bytes(60_000_000))
    assert "the custom data of the scene" in refusal(
        sim.writeCustomStringData, sim.handle_scene, "c", bytes(60_000_000)
    )
    for _ in range(60):
        refusal(sim.setNamedStringParam, "name", "x" * 5_000_000)
    assert status(node.process.pid, "VmRSS") < 700_000


@pytest.mark.parametrize("seconds", [float("inf"), float("nan"), -1.0, 1e10])
def test_a_wait_of_wall_time_is_at_most_a_day(node: RemoteNode, seconds: float) -> None:
    peer = node.raw()
    assert "is not a time to wait" in call(peer, "sim.wait", seconds, False)["err"]
    peer.close()


@pytest.mark.parametrize("seconds", [float("inf"), float("nan")])
def test_a_wait_of_simulated_time_is_finite(node: RemoteNode, seconds: float) -> None:
    peer = node.raw()
    call(peer, "sim.startSimulation")
    assert "is not a time to wait" in call(peer, "sim.wait", seconds)["err"]
    peer.close()


def test_waits_for_wall_time_need_no_thread_each_and_end_in_their_order(node: RemoteNode) -> None:
    before = status(node.process.pid, "Threads")
    long = [node.raw(zmq.DEALER) for _ in range(100)]
    for number, peer in enumerate(long):
        message = {"func": "sim.wait", "args": [1000.0, False], "uuid": f"long {number}"}
        peer.send_multipart([b"", cbor2.dumps(message)])
    short, shorter = node.raw(zmq.DEALER), node.raw(zmq.DEALER)
    start = time.monotonic()
    for peer, seconds in ((short, 0.6), (shorter, 0.3)):
        message = {"func": "sim.wait", "args": [seconds, False], "uuid": f"{seconds}"}
        peer.send_multipart([b"", cbor2.dumps(message)])
    assert cbor2.loads(shorter.recv_multipart()[-1]) == {"ret": [0.0]}
    assert time.monotonic() - start >= 0.3
    assert cbor2.loads(short.recv_multipart()[-1]) == {"ret": [0.0]}
    assert time.monotonic() - start >= 0.6
    assert status(node.process.pid, "Threads") <= before + 1
    for peer in (*long, short, shorter):
        peer.close()


def test_the_names_of_one_connection_do_not_evict_other_clients(node: RemoteNode) -> None:
    sim = node.sim()
    sim.setStepping(True)
    peer = node.raw()
    for number in range(2100):
        assert call(peer, "sim.getSimulationState", uuid=f"client {number}") == {"ret": [0]}
    assert sim.setStepping(True) == 1  # the level before
    peer.close()


def test_what_a_reader_of_frames_sends_does_not_stop_them(node: RemoteNode) -> None:
    with bubblesim.connect(node.port) as simulator:
        frames = simulator.frames()
        next(frames)
        simulator.sim.startSimulation()
        rogue = zmq.Context.instance().socket(zmq.DEALER)
        rogue.setsockopt(zmq.LINGER, 0)
        rogue.connect(f"tcp://127.0.0.1:{simulator.call('frames.open')[0]}")
        sent = time.monotonic()
        while time.monotonic() < sent + 1.0:
            rogue.send_multipart([b"x"] * 3)
            rogue.send(b"")
            time.sleep(0.01)
        now = next(frames).time
        later = next(frame.time for frame in frames if frame.time > now)
        assert later > now
        assert not rogue.poll(0)
        rogue.close()


def test_frames_are_for_those_whom_the_server_let_in(node: RemoteNode) -> None:
    with bubblesim.connect(node.port) as simulator:
        frames = simulator.frames()
        next(frames)
        simulator.sim.startSimulation()
        port, secret = simulator.call("frames.open")
        answered = {}
        for words in (b"", secret[:-1], bytes(len(secret)), secret):
            for kind in (zmq.REQ, zmq.SUB):
                reader = zmq.Context.instance().socket(kind)
                reader.setsockopt(zmq.LINGER, 0)
                reader.connect(f"tcp://127.0.0.1:{port}")
                if kind == zmq.REQ:
                    reader.send(words + bytes(8))
                else:
                    reader.setsockopt(zmq.SUBSCRIBE, words)
                answered[words, kind] = bool(reader.poll(1500))
                reader.close()
        assert [key for key, found in answered.items() if found] == [(secret, zmq.REQ)]


def test_replies_that_are_not_read_fill_no_memory(node: RemoteNode) -> None:
    large = 16  # MiB
    assert call(node.raw(), "sim.setStringSignal", "large", bytes(large << 20))["ret"] == []
    before = status(node.process.pid, "VmRSS")
    greedy = [zmq.Context.instance().socket(zmq.DEALER) for _ in range(4)]
    for peer in greedy:
        peer.setsockopt(zmq.LINGER, 0)
        peer.setsockopt(zmq.RCVHWM, 1)
        peer.connect(f"tcp://127.0.0.1:{node.port}")
        for _ in range(30):
            request = {"func": "sim.getStringSignal", "args": ["large"], "uuid": f"greedy {id(peer)}"}
            peer.send_multipart([b"", cbor2.dumps(request)])
    time.sleep(2.0)
    assert call(node.raw(), "sim.getSimulationTime", uuid="modest")["ret"] == [0.0]
    grown = (status(node.process.pid, "VmRSS") - before) / 1024
    assert grown < len(greedy) * 4 * large, f"{grown} MiB"
    for peer in greedy:
        peer.close()


def test_errors_of_messages_fill_no_log(tmp_path: Path) -> None:
    """No message is known that makes the server fail: a script breaks it from within."""
    code = """
        from bubblesim.remote import clients
        def fail(*arguments): raise ZeroDivisionError('broken')
        def sysCall_init(): clients.Clients.client_of = fail
    """
    script = write(tmp_path / "script.py", code)
    with RemoteNode(tmp_path, "--start", "--child-script", f"/Tricycle={script}") as node:
        peer = node.raw()
        wait_until(lambda: "broken" in str(call(peer, "sim.getSimulationTime")), "the script to break it")
        for _ in range(30):
            assert call(peer, "sim.getSimulationTime")["err"] == "broken"
        assert node.output.count("error: a message of a remote client: ZeroDivisionError: broken") == 20
        assert node.output.count("further ones are not reported") == 1


def test_the_graphs_of_a_scene_have_a_limit(node: RemoteNode) -> None:
    sim = node.sim()
    graphs = [sim.createDummy(0.01) for _ in range(3)]
    for graph in graphs[:2]:
        for number in range(500):
            sim.addGraphStream(graph, f"stream {number}")
    assert "at most 1000 streams" in refusal(sim.addGraphStream, graphs[2], "one more")
    assert "at most 1000 streams" in refusal(sim.addGraphCurve, graphs[0], "curve", 2, [0, 1])
    assert sim.addGraphStream(graphs[0], "stream 7", "m") == 7  # a change
    assert "at most 1000" in refusal(sim.addGraphStream, graphs[0], "x" * 1001)


def test_of_removed_models_the_last_hundred_can_be_brought_back(node: RemoteNode) -> None:
    with bubblesim.connect(node.port) as simulator:
        model = simulator.call("window.add_model", "PioneerP3DX", [3.0, 0.0, 0.5])
        numbers = []
        for _ in range(102):
            numbers.append(simulator.call("window.remove", model))
            model = simulator.call("window.restore", numbers[-1])
        assert len(set(numbers)) == 102
        for gone in numbers[:2]:
            with pytest.raises(RuntimeError, match="only the last 100 models"):
                simulator.call("window.restore", gone)
        assert simulator.call("window.restore", numbers[2]) >= 0


def test_a_connection_that_breaks_at_any_place_is_forgotten(node: RemoteNode) -> None:
    sim = node.sim()
    sim.startSimulation()
    for kind in ("sim.getSimulationTime", "sim.step", "sim.setStepping"):
        for _ in range(20):
            peer = node.raw(zmq.DEALER)
            peer.send_multipart([b"", cbor2.dumps({"func": kind, "args": [True], "uuid": f"breaks {kind}"})])
            peer.close()
    begin = sim.getSimulationTime()
    wait_until(lambda: sim.getSimulationTime() > begin, "a step")
