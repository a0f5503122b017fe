# SPDX-License-Identifier: BSD-3-Clause
"""The door for programs outside, driven by CoppeliaSim's own client and by raw sockets, against a running node."""

import asyncio
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import cbor2
import numpy as np
import pytest
import zmq
from coppeliasim_zmqremoteapi_client import RemoteAPIClient
from coppeliasim_zmqremoteapi_client.asyncio import RemoteAPIClient as AsyncClient

import bubblesim
from node_support import Node, run_sim, write
from ros_support import free_port, ros_environment, wait_until

TIMEOUT = 20_000  # ms for a reply


class Door(Node):
    """A node with a door, and its port."""

    def __init__(self, folder: Path, *options: object, scene: str = "tricycle") -> None:
        self.port = free_port()
        log = folder / f"node_{self.port}.txt"
        environment = ros_environment(free_port(), folder)
        super().__init__(environment, log, scene, "--no-ros", f"--remote={self.port}", *options)
        wait_until(lambda: "remote clients can connect" in self.output, "the door")

    def client(self) -> RemoteAPIClient:
        client = RemoteAPIClient(port=self.port)
        client.socket.setsockopt(zmq.RCVTIMEO, TIMEOUT)
        client.socket.setsockopt(zmq.LINGER, 0)
        return client

    def sim(self) -> Any:
        client = self.client()
        sim = client.require("sim")
        sim.client = client  # keeps the socket open
        return sim

    def raw(self, kind: int = zmq.REQ) -> "zmq.Socket[bytes]":
        socket = zmq.Context.instance().socket(kind)
        socket.setsockopt(zmq.RCVTIMEO, TIMEOUT)
        socket.setsockopt(zmq.LINGER, 0)
        socket.connect(f"tcp://127.0.0.1:{self.port}")
        return socket


@pytest.fixture
def door(tmp_path: Path) -> Iterator[Door]:
    with Door(tmp_path, "--speed", "max") as door:
        yield door
        assert door.process.poll() is None, door.output


def refusal(call: Callable[..., object], *arguments: object) -> str:
    with pytest.raises(Exception) as raised:  # noqa: PT011  # the client raises no other type
        call(*arguments)
    return str(raised.value)


def test_the_flow_of_the_clients_simple_test(tmp_path: Path) -> None:
    with Door(tmp_path) as door:
        sim = door.sim()
        handles = [sim.createDummy(0.01, 12 * [0]) for _ in range(50)]
        for i, handle in enumerate(handles):
            sim.setObjectPosition(handle, [0.01 * i, 0.01 * i, 0.01 * i], -1)
        assert sim.getObjectPosition(handles[7], -1) == pytest.approx([0.07] * 3)

        begin = time.monotonic()
        sim.startSimulation()
        while (now := sim.getSimulationTime()) < 3:
            sim.addLog(sim.verbosity_scriptinfos, f"Simulation time: {now:.2f} [s]")
        assert 2.5 < time.monotonic() - begin < 10
        sim.stopSimulation()
        while sim.getSimulationState() != sim.simulation_stopped:
            time.sleep(0.1)

        sim.setStepping(True)
        sim.startSimulation()
        times = []
        while (now := sim.getSimulationTime()) < 3:
            times.append(now)
            sim.step()
        assert times == pytest.approx([0.05 * i for i in range(60)])
        sim.stopSimulation()
        sim.removeObjects(handles)
        assert not sim.isHandle(handles[0])
        assert "Simulation time: 1." in door.output


def test_the_asyncio_client_works_on_several_sockets(door: Door) -> None:
    async def flow() -> None:
        async with AsyncClient(port=door.port) as client:
            sim = await client.require("sim")
            await sim.setStepping(True)
            await sim.startSimulation()
            for i in range(10):
                now, position, _ = await asyncio.gather(
                    sim.getSimulationTime(),
                    sim.getObjectPosition(await sim.getObject("/Tricycle")),
                    sim.getSimulationState(),
                )
                assert now == pytest.approx(0.05 * i)
                assert len(position) == 3
                await sim.step()
            await sim.stopSimulation()

    asyncio.run(asyncio.wait_for(flow(), TIMEOUT / 1000))


def test_calls_are_answered_in_every_state(door: Door) -> None:
    sim = door.sim()
    car = sim.getObject("/Tricycle")
    assert sim.getSimulationState() == sim.simulation_stopped
    start = sim.getObjectPosition(car)
    sim.startSimulation()
    assert sim.getSimulationState() == sim.simulation_advancing_running
    sim.setJointTargetVelocity(sim.getObject("/FrontMotor"), 2.0)
    sim.wait(2.0)
    sim.pauseSimulation()
    assert sim.getSimulationState() == sim.simulation_paused
    before = sim.getSimulationTime()
    assert before >= 2.0
    assert sim.getObjectPosition(car) != start
    assert sim.getSimulationTime() == before
    sim.startSimulation()
    sim.stopSimulation()
    assert (sim.getSimulationState(), sim.getSimulationTime()) == (sim.simulation_stopped, 0)
    assert sim.getObjectPosition(car) == pytest.approx(start, abs=1e-3)
    assert "is stopped" in refusal(sim.wait, 1.0)
    assert sim.step() is None


def test_errors_are_those_of_scripts(door: Door) -> None:
    sim = door.sim()
    expected = "sim.getObjectPosition: argument 1, handle: expected the handle of an object, an integer, found str 'x'"
    assert refusal(sim.getObjectPosition, "x") == expected
    assert "no object matches '/Tricyle'; did you mean /Tricycle?" in refusal(sim.getObject, "/Tricyle")
    client = sim.client
    assert "did you mean sim.getObjectPose" in refusal(client.call, "sim.getObjectPos", [1])
    assert "there is no function 'os.system'" in refusal(client.call, "os.system", ["true"])
    assert "there is no function" in refusal(client.call, "sim._simulation", [])
    assert "there is no function" in refusal(client.call, "sim.__class__", [])
    assert "there is no function 'zmqRemoteApi.eval'" in refusal(client.call, "zmqRemoteApi.eval", ["1"])
    assert "is a constant" in refusal(client.call, "sim.handle_world", [])
    assert "module 'os' not found" in refusal(client.require, "os")
    assert "must not start" in refusal(sim.launchExecutable, "/bin/true")
    assert sim.getSimulationState() == 0


def test_two_clients_step_together(door: Door) -> None:
    one, two, watching = door.sim(), door.sim(), door.sim()
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


def test_wait_runs_the_steps_of_a_stepping_client(door: Door) -> None:
    sim = door.sim()
    sim.setStepping(True)
    sim.startSimulation()
    sim.wait(0.5)
    assert sim.getSimulationTime() == pytest.approx(0.5)
    begin = time.monotonic()
    sim.wait(0.2, False)
    assert time.monotonic() - begin >= 0.2
    assert sim.getSimulationTime() == pytest.approx(0.5)


def test_callbacks_run_in_the_client(door: Door) -> None:
    sim = door.sim()
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
    with Door(tmp_path, "--child-script", f"/Ball={script}", "--speed", "max", scene="ball") as door:
        sim = door.sim()
        ball = sim.getScript(sim.scripttype_simulation, "/Ball")
        assert "the simulation is stopped" in refusal(sim.callScriptFunction, "add", ball, 1, 2)
        sim.setStepping(True)
        sim.startSimulation()
        sim.step()
        assert sim.callScriptFunction("add", ball, 1, 2) == 3
        assert sim.getScriptFunctions(ball).add(3, 4) == 7
        assert "ZeroDivisionError" in refusal(sim.callScriptFunction, "fail", ball)
        heard = []
        sim.callScriptFunction("listen", ball, lambda *values: heard.append(values))
        for _ in range(5):
            sim.step()
        sim.getSimulationTime()
        assert [b for _, b in heard] == [b"\x00\xff"] * 5
        assert [t for t, _ in heard] == pytest.approx([0.05 * i for i in range(1, 6)])


def test_images_go_both_ways(tmp_path: Path) -> None:
    with Door(tmp_path, "--speed", "max", scene="pioneer") as door:
        sim = door.sim()
        cameras = sim.getObjectsInTree(sim.handle_scene, sim.object_visionsensor_type)
        data, (width, height) = sim.getVisionSensorImg(cameras[0])
        assert isinstance(data, bytes)
        assert len(data) == width * height * 3
        painted = np.random.default_rng(1).integers(0, 256, len(data), dtype=np.uint8).tobytes()
        sim.setVisionSensorImg(cameras[0], painted)
        assert sim.getVisionSensorImg(cameras[0])[0] == painted


def test_signals_and_data_live_on_the_stopped_scene(door: Door) -> None:
    one, two = door.sim(), door.sim()
    one.setStringSignal("text", "here")
    one.setBoolProperty(one.handle_scene, "signal.go", True)
    one.writeCustomDataBlock(one.getObject("/Tricycle"), "tag", b"\x00\xff")
    assert two.getStringSignal("text") == "here"
    assert two.getBoolProperty(two.handle_scene, "signal.go") is True
    one.startSimulation()
    one.stopSimulation()
    assert two.readCustomDataBlock(two.getObject("/Tricycle"), "tag") == b"\x00\xff"
    assert two.unpackTable(two.packTable([1, {"a": 2}])) == [1, {"a": 2}]


def test_the_scene_of_the_node_is_loaded_again_and_no_other(door: Door) -> None:
    sim = door.sim()
    sim.createDummy(0.1)
    sim.startSimulation()
    temporary = sim.createDummy(0.1)
    sim.stopSimulation()
    assert not sim.isHandle(temporary)
    assert sim.isHandle(sim.getObject("/Dummy"))
    assert sim.loadScene("/somewhere/tricycle.ttt") == 1
    assert sim.getObject("/Dummy", {"noError": True}) == -1
    assert "rosrun bubblesim sim pioneer --remote" in refusal(sim.loadScene, "C:\\scenes\\pioneer.ttt")
    assert "searched:" in refusal(sim.loadScene, "nowhere.ttt")
    assert "there is no model 'nothing'" in refusal(sim.loadModel, "../../nothing.ttm")
    assert sim.closeScene() == 1


KILLED = """
import sys, time
from coppeliasim_zmqremoteapi_client import RemoteAPIClient
sim = RemoteAPIClient(port=int(sys.argv[1])).require('sim')
sim.setStepping(True)
if sim.getSimulationState() == sim.simulation_stopped:
    sim.startSimulation()
print('ready', flush=True)
PHASES = {
    'step': lambda: sim.step(),
    'call': lambda: sim.getObjectPosition(sim.getObject('/Tricycle')),
    'wait': lambda: sim.wait(1000.0),
    'idle': lambda: time.sleep(1000),
    'callback': lambda: sim.testCB(1, lambda a, b: time.sleep(1000), 2),
}
while True:
    PHASES[sys.argv[2]]()
"""


@pytest.mark.parametrize("phase", ["step", "call", "wait", "idle", "callback"])
def test_a_killed_client_releases_the_simulation(door: Door, tmp_path: Path, phase: str) -> None:
    program = write(tmp_path / "client.py", KILLED)
    sim = door.sim()
    for pause in (0.0, 0.003, 0.01, 0.05):
        command = [sys.executable, str(program), str(door.port), phase]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
            assert process.stdout
            assert process.stdout.readline() == "ready\n"
            time.sleep(pause)
            os.kill(process.pid, signal.SIGKILL)
        before = sim.getSimulationTime()
        wait_until(lambda before=before: sim.getSimulationTime() > before + 0.2, "the simulation to run on")
        assert sim.getSimulationState() == sim.simulation_advancing_running


def test_a_client_that_is_silent_for_its_timeout_is_released(door: Door) -> None:
    sim = door.sim()
    silent = door.raw()
    for message in (
        {"func": "sim.setStepping", "args": [True], "uuid": "silent", "ver": 2, "timeout": 1},
        {"func": "sim.startSimulation", "args": [], "uuid": "silent"},
    ):
        silent.send(cbor2.dumps(message))
        assert "ret" in cbor2.loads(silent.recv())
    assert sim.getSimulationTime() == 0
    wait_until(lambda: sim.getSimulationTime() > 0, "the release")
    assert "is silent for 1 s and was released" in door.output
    silent.close()


def test_strange_messages_get_an_error(door: Door) -> None:
    socket = door.raw()

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
    parts = door.raw(zmq.DEALER)
    for message in ([b"x"], [b"", b"a", b"b"], [b"\x00" * 10, b""], [b""]):
        parts.send_multipart(message)
    too_large = door.raw()
    too_large.send(bytes(70_000_000))
    assert door.sim().getSimulationState() == 0
    parts.close()
    too_large.close()


def test_a_flood_stops_neither_steps_nor_other_clients(door: Door) -> None:
    sim = door.sim()
    sim.startSimulation()
    flood = door.raw(zmq.DEALER)
    request = cbor2.dumps({"func": "sim.getSimulationTime", "args": [], "uuid": "flood"})
    deadline = time.monotonic() + 2.0
    sent = 0
    begin = sim.getSimulationTime()
    while time.monotonic() < deadline:
        try:
            flood.send_multipart([b"", request], zmq.NOBLOCK)
            sent += 1
        except zmq.Again:
            pass
        if sent % 5000 == 0:
            assert sim.getSimulationTime() >= begin
    assert sent > 1000
    assert sim.getSimulationTime() > begin + 1.0
    flood.close()


def test_many_idle_clients_do_no_harm(door: Door) -> None:
    sim = door.sim()
    idle = []
    for number in range(200):
        socket = door.raw()
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


def test_a_silent_client_changes_nothing(tmp_path: Path) -> None:
    options = ["--no-ros", "--speed", "max", "--until", 3, "--state-hash", "--seed", 5]
    alone = run_sim("tricycle", *options).stdout.split()[-1]
    with Door(tmp_path, "--speed", 2, "--start", *options[3:]) as door:
        sim = door.sim()
        sim.getObject("/Tricycle")
        door.process.wait(20)
        assert door.output.split()[-1] == alone


def test_the_end_of_the_node_is_told_to_those_who_wait(tmp_path: Path) -> None:
    with Door(tmp_path) as door:
        one, two = door.sim(), door.sim()
        one.startSimulation()
        one.pauseSimulation()
        raw = door.raw()
        for name in ("sim.getSimulationTime", "sim.step"):
            raw.send(cbor2.dumps({"func": name, "args": [], "uuid": "waits"}))
            assert name == "sim.step" or cbor2.loads(raw.recv()) == {"ret": [one.getSimulationTime()]}
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


def test_bubblesim_connect_has_typed_results(door: Door) -> None:
    with bubblesim.connect(door.port) as simulator:
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
    other = door.sim()
    other.wait(0.5)  # the connection has ended its stepping


def test_bubblesim_connect_says_that_nobody_answers() -> None:
    port = free_port()
    with pytest.raises(TimeoutError, match=f"no answer from 127.0.0.1:{port}"):
        bubblesim.connect(port, timeout=0.2)


def test_no_function_falls_over_odd_arguments(door: Door) -> None:
    odd = [None, -5, 2**64 - 1, float("nan"), "text", b"bytes", [], [1, 2, 3], {"a": 1}, "f@func", "_*NIL*_"]
    others = {"quitSimulator", "wait", "step", "switchThread", "stopSimulation", "pauseSimulation", "closeScene"}
    socket = door.raw()

    def call(function: str, *arguments: object) -> Any:
        socket.send(cbor2.dumps({"func": function, "args": list(arguments), "uuid": "odd"}))
        return cbor2.loads(socket.recv())

    (known,) = call("zmqRemoteApi.info", "sim")["ret"]
    names = sorted(name for name, entry in known.items() if "func" in entry and name not in others)
    assert len(names) > 120
    for name in names:
        for arguments in ((), *((a,) for a in odd), *((a, b) for a in odd[:6] for b in odd)):
            reply = call(f"sim.{name}", *arguments)
            assert reply.keys() in ({"ret"}, {"err"}), (name, arguments, reply)
            assert "incompatible function arguments" not in reply.get("err", ""), (name, arguments, reply)
    assert call("sim.stopSimulation").keys() <= {"ret"}
    assert call("sim.getSimulationState") == {"ret": [0]}
    socket.close()
