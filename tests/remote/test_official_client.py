# SPDX-License-Identifier: BSD-3-Clause
"""CoppeliaSim's own client, installed and unchanged, against a running node."""

import asyncio
import time
from pathlib import Path

import numpy as np
import pytest
from coppeliasim_zmqremoteapi_client.asyncio import RemoteAPIClient as AsyncClient

from remote_support import TIMEOUT, RemoteNode, refusal
from ros_support import DEADLINE


def test_the_flow_of_the_clients_simple_test(tmp_path: Path) -> None:
    with RemoteNode(tmp_path) as node:
        sim = node.sim()
        handles = [sim.createDummy(0.01, 12 * [0]) for _ in range(50)]
        for i, handle in enumerate(handles):
            sim.setObjectPosition(handle, [0.01 * i, 0.01 * i, 0.01 * i], -1)
        assert sim.getObjectPosition(handles[7], -1) == pytest.approx([0.07] * 3)

        begin = time.monotonic()
        sim.startSimulation()
        while (now := sim.getSimulationTime()) < 3:
            sim.addLog(sim.verbosity_scriptinfos, f"Simulation time: {now:.2f} [s]")
        assert 2.5 < time.monotonic() - begin < 3 * DEADLINE  # a busy machine may be slower than real time
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
        assert "Simulation time: 1." in node.output


def test_the_asyncio_client_works_on_several_sockets(node: RemoteNode) -> None:
    async def flow() -> None:
        async with AsyncClient(port=node.port) as client:
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


def test_the_flow_of_the_clients_test_without_blocking(node: RemoteNode) -> None:
    async def flow() -> None:
        async with AsyncClient(port=node.port) as client:
            sim = await client.require("sim")
            handles = await asyncio.gather(*(sim.createDummy(0.01, 12 * [0]) for _ in range(50)))
            assert len(set(handles)) == 50
            await asyncio.gather(*(sim.setObjectPosition(h, [0.01 * i] * 3, -1) for i, h in enumerate(handles)))
            places = await asyncio.gather(*(sim.getObjectPosition(handle) for handle in handles))
            assert np.array(places) == pytest.approx(np.full((50, 3), 0.01) * np.arange(50)[:, None])
            for stepping in (False, True):
                await sim.setStepping(stepping)
                await sim.startSimulation()
                times = []
                while (now := await sim.getSimulationTime()) < 3:
                    times.append(now)
                    if stepping:
                        await asyncio.gather(sim.step(), sim.addLog(sim.verbosity_scriptinfos, f"at {now:.2f} s"))
                await sim.stopSimulation()
                while await sim.getSimulationState() != sim.simulation_stopped:
                    await asyncio.sleep(0.01)
                assert not stepping or times == pytest.approx([0.05 * i for i in range(60)])
            await sim.removeObjects(handles)
            assert not any(await asyncio.gather(*(sim.isHandle(handle) for handle in handles)))

    asyncio.run(asyncio.wait_for(flow(), 3 * TIMEOUT / 1000))
    assert "at 1.00 s" in node.output


def test_calls_are_answered_in_every_state(node: RemoteNode) -> None:
    sim = node.sim()
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


def test_errors_are_those_of_scripts(node: RemoteNode) -> None:
    sim = node.sim()
    expected = "sim.getObjectPosition: argument 1, handle: expected the handle of an object, an integer, found list []"
    assert refusal(sim.getObjectPosition, []) == expected
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


def test_images_go_both_ways(tmp_path: Path) -> None:
    with RemoteNode(tmp_path, "--speed", "max", scene="pioneer") as node:
        sim = node.sim()
        cameras = sim.getObjectsInTree(sim.handle_scene, sim.object_visionsensor_type)
        data, (width, height) = sim.getVisionSensorImg(cameras[0])
        assert isinstance(data, bytes)
        assert len(data) == width * height * 3
        painted = np.random.default_rng(1).integers(0, 256, len(data), dtype=np.uint8).tobytes()
        sim.setVisionSensorImg(cameras[0], painted)
        assert sim.getVisionSensorImg(cameras[0])[0] == painted


def test_signals_and_data_live_on_the_stopped_scene(node: RemoteNode) -> None:
    one, two = node.sim(), node.sim()
    one.setStringSignal("text", "here")
    one.setBoolProperty(one.handle_scene, "signal.go", True)
    one.writeCustomDataBlock(one.getObject("/Tricycle"), "tag", b"\x00\xff")
    assert two.getStringSignal("text") == "here"
    assert two.getBoolProperty(two.handle_scene, "signal.go") is True
    one.startSimulation()
    one.stopSimulation()
    assert two.readCustomDataBlock(two.getObject("/Tricycle"), "tag") == b"\x00\xff"
    assert two.unpackTable(two.packTable([1, {"a": 2}])) == [1, {"a": 2}]
