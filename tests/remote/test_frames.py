# SPDX-License-Identifier: BSD-3-Clause
"""The frames that a node publishes for programs outside."""

import time
from pathlib import Path

import numpy as np
import pytest

import bubblesim
from remote_support import RemoteNode


def test_frames_show_the_poses_of_the_moving_links(node: RemoteNode) -> None:
    with bubblesim.connect(node.port) as simulator:
        sim = simulator.sim
        frames = simulator.frames()
        first = next(frames)
        assert (first.time, first.state) == (0.0, "stopped")
        assert first.poses.shape == (len(first.links), 7)
        assert len(first.joints) == len(first.joint_positions)
        sim.setStepping(True)
        sim.startSimulation()
        sim.setJointTargetVelocity(sim.getObject("/FrontMotor"), 2.0)
        for _ in range(20):
            sim.step()
        last = next(frame for frame in frames if frame.time > 0.99)
        link = last.links[0]
        expected = sim.getObjectPose(sim.getObject(link))
        np.testing.assert_allclose(last.poses[0], expected, atol=1e-6)
        motor = last.joint_positions[last.joints.index(("/Tricycle/FrontMotor", 0))]
        assert motor == pytest.approx(sim.getJointPosition(sim.getObject("/FrontMotor")), abs=1e-6)


def test_frames_go_on_when_models_and_scenes_change(node: RemoteNode) -> None:
    with bubblesim.connect(node.port) as simulator:
        frames = simulator.frames()
        before = next(frames)
        added = simulator.sim.loadModel("PioneerP3DX")
        path = simulator.sim.getObjectAlias(added, 2)
        more = next(frame for frame in frames if len(frame.links) > len(before.links))
        assert any(link.startswith(path) for link in more.links)
        simulator.sim.loadScene("ball")
        other = next(frame for frame in frames if frame.links != more.links)
        assert len(other.links) == 1


def test_a_reader_that_is_slow_gets_the_last_frame(node: RemoteNode) -> None:
    with bubblesim.connect(node.port) as simulator:
        frames = simulator.frames()
        next(frames)
        simulator.sim.startSimulation()
        time.sleep(1.0)
        simulator.sim.pauseSimulation()
        end = simulator.sim.getSimulationTime()
        next(frame for frame in simulator.frames() if frame.time >= end - 1e-9)  # it was sent to all readers
        time.sleep(0.5)
        assert next(frame.time for frame in frames if frame.time) >= end - 1e-9


def test_frames_end_with_an_error_when_the_node_is_gone(tmp_path: Path) -> None:
    with RemoteNode(tmp_path) as node, bubblesim.connect(node.port, timeout=8.0) as simulator:
        frames = simulator.frames()
        next(frames)
        time.sleep(2.0)
        node.process.kill()
        with pytest.raises(TimeoutError, match=r"no frame from 127\.0\.0\.1 in 8 s"):
            for _ in frames:
                pass
