# SPDX-License-Identifier: BSD-3-Clause
"""gz-sim's DetachableJoint: a load below a crane, and one that is added later."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import bubblesim
from bubblesim.gazebo_plugins.robots import GazeboPlugins
from ros_peer import Messages, Peer

CRANE = (
    '<model name="crane"><link name="hook"><pose>0 0 3 0 0 0</pose></link>'
    '<joint name="mast" type="fixed"><parent>world</parent><child>hook</child></joint>'
    '<plugin filename="gz-sim-detachable-joint-system" name="gz::sim::systems::DetachableJoint">'
    "<parent_link>hook</parent_link><child_model>load</child_model><child_link>body</child_link>{}</plugin></model>"
)
LOAD = '<model name="load"><pose>0 0 {} 0 0 0</pose><link name="body"/></model>'


def world(parameters: str, *models: str) -> str:
    content = CRANE.format(parameters) + "".join(models)
    return f'<sdf version="1.9"><world name="w">{content}</world></sdf>'


def load_height(simulation: bubblesim.Simulation) -> float:
    return float(simulation.object("/load").position[2])


def test_it_is_attached_from_the_start_also_after_a_reset(tmp_path: Path) -> None:
    (tmp_path / "w.sdf").write_text(world("", LOAD.format(2)))
    simulation = bubblesim.Simulation(str(tmp_path / "w.sdf"))
    plugins = GazeboPlugins(simulation, None)
    for _ in range(2):
        for _ in range(20):
            plugins.actuate()
            simulation.step()
        assert load_height(simulation) == pytest.approx(2.0, abs=1e-5)
        assert len(simulation.world.attachments) == 1
        simulation.reset()
        plugins.reset()


def test_with_initial_attach_false_it_is_loose(tmp_path: Path) -> None:
    (tmp_path / "w.sdf").write_text(world("<initial_attach>false</initial_attach>", LOAD.format(2)))
    simulation = bubblesim.Simulation(str(tmp_path / "w.sdf"))
    GazeboPlugins(simulation, None).actuate()
    simulation.step(10)
    assert load_height(simulation) < 1.0


def test_a_child_that_is_added_later_is_attached_then(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "w.sdf").write_text(world(""))
    simulation = bubblesim.Simulation(str(tmp_path / "w.sdf"))
    plugins = GazeboPlugins(simulation, None)
    plugins.actuate()
    assert "there is no model 'load'" in capfd.readouterr().err
    simulation.add_model(f'<sdf version="1.9">{LOAD.format(1.5)}</sdf>')
    for _ in range(20):
        plugins.actuate()
        simulation.step()
    assert load_height(simulation) == pytest.approx(1.5, abs=1e-5)


@pytest.fixture(scope="module")
def peer(run: Callable[..., Any], tmp_path_factory: pytest.TempPathFactory) -> Peer:
    scene = tmp_path_factory.mktemp("crane") / "w.sdf"
    names = "<output_topic>hook/state</output_topic><attach_topic>hook/attach</attach_topic><topic>hook/release</topic>"
    p3d = (
        '<plugin filename="libgazebo_ros_p3d.so" name="p3d"><robotNamespace>/</robotNamespace>'
        "<bodyName>body</bodyName><topicName>pose</topicName></plugin></model>"
    )
    scene.write_text(world(names, LOAD.format(2).replace("</model>", p3d)))
    found: Peer = run(scene).peer
    return found


def test_messages_detach_and_attach(peer: Peer) -> None:
    states = Messages(peer, "/hook/state", "std_msgs/String")
    states.next(lambda m: m["data"] == "attached", "the state of now")
    peer.publish("/hook/release", "std_msgs/Empty", {})
    states.next(lambda m: m["data"] == "detached", "the load to be detached")
    peer.wait_for("/pose", "nav_msgs/Odometry", lambda m: m["pose"]["pose"]["position"]["z"] < 1.9, "the load to fall")
    peer.publish("/hook/attach", "std_msgs/Empty", {})
    states.next(lambda m: m["data"] == "attached", "the load to be attached")
    peer.wait_for(
        "/pose", "nav_msgs/Odometry", lambda m: abs(m["twist"]["twist"]["linear"]["z"]) < 1e-3, "the load to hang"
    )
