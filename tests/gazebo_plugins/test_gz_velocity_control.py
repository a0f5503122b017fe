# SPDX-License-Identifier: BSD-3-Clause
"""gz-sim's VelocityControl: circles of models and links that have a constant velocity."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import bubblesim
from bubblesim.gazebo_plugins.robots import GazeboPlugins
from ros_peer import Message, Peer


def model(name: str, parameters: str, links: str = '<link name="body"/>') -> str:
    system = "gz-sim-velocity-control-system"
    plugin = f'<plugin filename="{system}" name="gz::sim::systems::VelocityControl">{parameters}</plugin>'
    odometry = '<plugin filename="gz-sim-odometry-publisher-system" name="odometry"/>'
    return f'<model name="{name}">{links}{plugin}{odometry}</model>'


def world(*models: str) -> str:
    return f'<sdf version="1.9"><world name="w"><gravity>0 0 0</gravity>{"".join(models)}</world></sdf>'


def test_the_initial_velocity_acts_along_the_axes_of_the_model_also_without_ros(tmp_path: Path) -> None:
    first = "<initial_linear>0.3 0 0.1</initial_linear><initial_angular>0 0 -0.5</initial_angular>"
    (tmp_path / "w.sdf").write_text(world(model("car", first)))
    simulation = bubblesim.Simulation(str(tmp_path / "w.sdf"))
    plugins = GazeboPlugins(simulation, None)
    car = simulation.object("/car")
    for _ in range(2):
        simulation.step(40)  # 2 s: a right-hand circle of radius v / w, 1 rad of it
        radius, angle = 0.3 / 0.5, 0.5 * 2.0
        expected = radius * math.sin(angle), -radius * (1 - math.cos(angle)), 0.1 * 2.0
        assert [float(x) for x in car.position] == pytest.approx(expected, abs=3e-3)
        simulation.reset()
        plugins.reset()


@pytest.fixture(scope="module")
def peer(run: Callable[..., Any], tmp_path_factory: pytest.TempPathFactory) -> Peer:
    scene = tmp_path_factory.mktemp("velocity") / "w.sdf"
    pair = (
        '<link name="body"/><link name="turret"><pose>0 0 5 0 0 0</pose></link>'
        '<plugin filename="libgazebo_ros_p3d.so" name="p3d"><robotNamespace>/</robotNamespace>'
        "<bodyName>turret</bodyName><topicName>turret</topicName></plugin>"
    )
    scene.write_text(world(model("car", ""), model("named", "<topic>go</topic><link_name>turret</link_name>", pair)))
    found: Peer = run(scene, "--speed", "4").peer
    return found


def twist_of(peer: Peer, name: str) -> Callable[[tuple[float, ...]], None]:
    def becomes(wanted: tuple[float, ...]) -> None:
        def holds(message: Message) -> bool:
            twist = message["twist"]["twist"]
            found = twist["linear"]["x"], twist["linear"]["y"], twist["angular"]["z"]
            return bool(found == pytest.approx(wanted, abs=0.01))

        peer.wait_for(f"/model/{name}/odometry", "nav_msgs/Odometry", holds, f"{name} to move at {wanted}")

    return becomes


def test_a_twist_sets_the_velocity_until_the_next_one(peer: Peer) -> None:
    becomes = twist_of(peer, "car")
    becomes((0.0, 0.0, 0.0))
    twist = {"linear": {"x": 0.4, "y": -0.2, "z": 0.0}, "angular": {"x": 0.0, "y": 0.0, "z": 0.6}}
    peer.publish("/model/car/cmd_vel", "geometry_msgs/Twist", twist)
    becomes((0.4, -0.2, 0.6))
    peer.drive("/model/car/cmd_vel", 0.0, 0.0)
    becomes((0.0, 0.0, 0.0))


def test_a_topic_is_named_and_links_have_their_own(peer: Peer) -> None:
    peer.drive("/go", 0.5, 0.0)
    twist_of(peer, "named")((0.5, 0.0, 0.0))

    def turns(message: Message) -> bool:
        twist = message["twist"]["twist"]
        return bool((twist["linear"]["x"], twist["angular"]["z"]) == pytest.approx((0.5, 1.0), abs=0.01))

    peer.drive("/model/named/link/turret/cmd_vel", 0.5, 1.0)
    peer.wait_for("/turret", "nav_msgs/Odometry", turns, "the turret to turn")
    twist_of(peer, "named")((0.5, 0.0, 0.0))
