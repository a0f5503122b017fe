# SPDX-License-Identifier: BSD-3-Clause
"""gz-sim's tracks: a vehicle with two narrow tracks that touch the ground at their ends."""

import math
from collections.abc import Callable
from typing import Any

import pytest

from bubblesim.gazebo_plugins.drives.speed_limiter import SpeedLimiter
from plugin_models import GROUND, plugin
from ros_peer import Message, Peer

LENGTH, SEPARATION = 0.6, 0.5  # m, of the tracks
# Coulomb's friction at the four ends balances where (v - w B/2) B/2 = w (L/2)^2, v being the speed of the tracks.
EFFICIENCY = (SEPARATION / 2) ** 2 / ((SEPARATION / 2) ** 2 + (LENGTH / 2) ** 2)


def track(side: str, y: float) -> str:
    inertial = "<inertial><mass>2</mass><inertia><ixx>.01</ixx><iyy>.06</iyy><izz>.06</izz></inertia></inertial>"
    shape = f"<collision name='belt'><geometry><box><size>{LENGTH} 0.01 0.1</size></box></geometry></collision>"
    return (
        f"<link name='{side}'><pose>0 {y} 0.05 0 0 0</pose>{inertial}{shape}</link>"
        f"<joint name='{side}_mount' type='fixed'><parent>body</parent><child>{side}</child></joint>"
    )


def tank(y: float, name: str, plugins: str) -> str:
    inertial = "<inertial><mass>6</mass><inertia><ixx>.2</ixx><iyy>.2</iyy><izz>.3</izz></inertia></inertial>"
    body = f"<link name='body'><pose>0 0 0.05 0 0 0</pose>{inertial}</link>"
    tracks = track("left", SEPARATION / 2) + track("right", -SEPARATION / 2)
    truth = plugin("gz-sim-odometry-publisher-system", odom_topic=f"{name}/truth")
    return f"<model name='{name}'><pose>0 {y} 0 0 0 0</pose>{body}{tracks}{plugins}{truth}</model>"


CONTROLLERS = "".join(plugin("gz-sim-track-controller-system", link=side) for side in ("left", "right"))
VEHICLE = (
    '<plugin filename="gz-sim-tracked-vehicle-system" name="gz::sim::systems::TrackedVehicle">'
    "<left_track><link>left</link></left_track><right_track><link>right</link></right_track>"
    f"<tracks_separation>{SEPARATION}</tracks_separation><steering_efficiency>{EFFICIENCY}</steering_efficiency>"
    "<linear_velocity><max_velocity>0.6</max_velocity><max_acceleration>1</max_acceleration></linear_velocity></plugin>"
)


@pytest.fixture(scope="module")
def peer(run: Callable[..., Any], tmp_path_factory: pytest.TempPathFactory) -> Peer:
    scene = tmp_path_factory.mktemp("tracks") / "w.sdf"
    models = tank(0, "tank", CONTROLLERS + VEHICLE) + tank(3, "bare", CONTROLLERS)
    scene.write_text(f'<sdf version="1.9"><world name="w">{GROUND}{models}</world></sdf>')
    found: Peer = run(scene, "--speed", "4").peer
    return found


def becomes(peer: Peer, topic: str, forward: float, turning: float) -> None:
    def holds(message: Message) -> bool:
        twist = message["twist"]["twist"]
        found = twist["linear"]["x"], twist["angular"]["z"]
        return bool(found == pytest.approx((forward, turning), abs=0.02))

    peer.wait_for(topic, "nav_msgs/Odometry", holds, f"{topic} to show {forward} m/s and {turning} rad/s")


def test_a_tracked_vehicle_drives_and_turns_at_its_command(peer: Peer) -> None:
    peer.drive("/model/tank/cmd_vel", 0.4, 0.0)
    becomes(peer, "/tank/truth", 0.4, 0.0)
    becomes(peer, "/model/tank/odometry", 0.4, 0.0)
    peer.drive("/model/tank/cmd_vel", 0.0, 0.8)
    becomes(peer, "/tank/truth", 0.0, 0.8)
    becomes(peer, "/model/tank/odometry", 0.0, 0.8)
    peer.drive("/model/tank/cmd_vel", 2.0, 0.0)
    becomes(peer, "/tank/truth", 0.6, 0.0)


def test_tracks_have_topics_of_their_own(peer: Peer) -> None:
    for side, speed in (("left", -0.3), ("right", 0.3)):
        peer.publish(f"/model/bare/link/{side}/track_cmd_vel", "std_msgs/Float64", {"data": speed})
    becomes(peer, "/bare/truth", 0.0, 0.3 / (SEPARATION / 2) * EFFICIENCY)


def test_a_limiter_keeps_to_velocity_acceleration_and_jerk() -> None:
    limiter = SpeedLimiter((-1.0, 2.0), (-4.0, 3.0), (-math.inf, 10.0))
    speeds = [limiter.limited(5.0, 0.1) for _ in range(40)]
    assert speeds[:3] == pytest.approx([0.1, 0.3, 0.6]), "by the jerk, then by the acceleration"
    assert speeds[-1] == 2.0
    assert limiter.limited(-5.0, 0.1) == pytest.approx(1.6)
