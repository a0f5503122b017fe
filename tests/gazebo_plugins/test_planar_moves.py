# SPDX-License-Identifier: BSD-3-Clause
"""Models that follow a Twist in the plane, in one world."""

from collections.abc import Callable
from typing import Any

import pytest

from node_support import write
from plugin_models import link, moving, plugin, world
from ros_peer import Peer

PLANAR = plugin("libgazebo_ros_planar_move.so", robotNamespace="sledge", odometryFrame="odom", robotBaseFrame="body")
PUSHED = plugin(
    "libgazebo_ros_force_based_move.so", robotNamespace="pushed", robotBaseFrame="body", yaw_velocity_p_gain="10000"
)
BOX = link("body", 0, 0, 0, 5, 0.1, "<box><size>0.5 0.5 0.1</size></box>")

WORLD = world(
    f'<model name="sledge"><pose>0 50 0.05 0 0 0</pose>{BOX}{PLANAR}</model>',
    f'<model name="pushed"><pose>0 120 0.05 0 0 0</pose>{BOX}{PUSHED}</model>',
)


@pytest.fixture(scope="module")
def running(run: Callable[..., Any], tmp_path_factory: pytest.TempPathFactory) -> Any:
    file = write(tmp_path_factory.mktemp("planar") / "planar.sdf", WORLD)
    return run(file, "--speed", "4", "--gazebo-compat")


def test_a_planar_move_goes_in_all_directions_against_friction(peer: Peer) -> None:
    peer.publish("/sledge/cmd_vel", "geometry_msgs/Twist", {"linear": {"x": 0.3, "y": 0.2}, "angular": {"z": 0.5}})
    twist = moving(peer, "/sledge/odom", "yaw", 0.45)["twist"]["twist"]
    # At the end of a step it has turned by half a step's angle more than the velocity command assumed.
    assert (twist["linear"]["x"], twist["linear"]["y"]) == pytest.approx((0.3, 0.2), abs=0.01)
    assert twist["angular"]["z"] == pytest.approx(0.5, abs=0.01)


def test_a_force_based_move_lags_behind_by_its_friction(peer: Peer) -> None:
    """A force of gain * error balances the friction of 5 kg: 49 N by 10,000 N s/m."""
    peer.publish("/pushed/cmd_vel", "geometry_msgs/Twist", {"linear": {"x": 0.3}})
    linear = moving(peer, "/pushed/odom", "x", 0.29)["twist"]["twist"]["linear"]
    assert linear["x"] == pytest.approx(0.3 - 5 * 9.81 / 10000, abs=2e-4)
    peer.publish("/pushed/cmd_vel", "geometry_msgs/Twist", {"linear": {"y": -0.2}, "angular": {"z": 0.5}})
    twist = moving(peer, "/pushed/odom", "yaw", 0.45)["twist"]["twist"]
    assert (twist["linear"]["x"], twist["linear"]["y"]) == pytest.approx((0.0, -0.2), abs=0.01)
    assert twist["angular"]["z"] == pytest.approx(0.5, abs=0.01)
