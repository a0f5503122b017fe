# SPDX-License-Identifier: BSD-3-Clause
"""Wheels that slip: parameters and topics; the law is tested in tests/sim/devices/test_wheel_slip.cpp."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import bubblesim
from bubblesim.gazebo_plugins.robots import GazeboPlugins
from ros_peer import Message, Peer

RADIUS, TRACK, MASS = 0.1, 0.4, 6.0  # m, m, kg
LOAD = MASS * 9.81 / 4  # N, on each wheel


def wheel(name: str, x: float, y: float) -> str:
    inertial = "<inertial><mass>0.5</mass><inertia><ixx>.002</ixx><iyy>.002</iyy><izz>.002</izz></inertia></inertial>"
    shape = f'<collision name="tyre"><geometry><sphere><radius>{RADIUS}</radius></sphere></geometry></collision>'
    return (
        f'<link name="{name}"><pose>{x} {y} {RADIUS} 0 0 0</pose>{inertial}{shape}</link>'
        f'<joint name="{name}_axle" type="revolute"><parent>body</parent><child>{name}</child>'
        "<axis><xyz>0 1 0</xyz></axis></joint>"
    )


WHEELS = {
    f"{end}_{side}": (x, y) for end, x in (("front", 0.3), ("rear", -0.3)) for side, y in (("l", 0.2), ("r", -0.2))
}


def slip_of(filename: str, lateral: float = 0.0, longitudinal: float = 0.0) -> str:
    wheels = "".join(
        f'<wheel link_name="{name}"><slip_compliance_lateral>{lateral}</slip_compliance_lateral>'
        f"<slip_compliance_longitudinal>{longitudinal}</slip_compliance_longitudinal>"
        f"<wheel_normal_force>{LOAD}</wheel_normal_force></wheel>"
        for name in WHEELS
    )
    return f'<plugin name="slip" filename="{filename}">{wheels}</plugin>'


def cart(plugin: str, gravity: str) -> str:
    inertial = "<inertial><mass>4</mass><inertia><ixx>.1</ixx><iyy>.1</iyy><izz>.1</izz></inertia></inertial>"
    body = f'<link name="body"><pose>0 0 {RADIUS} 0 0 0</pose>{inertial}</link>'
    parts = "".join(wheel(name, x, y) for name, (x, y) in WHEELS.items())
    return (
        f'<sdf version="1.9"><world name="w"><gravity>{gravity}</gravity>'
        '<model name="ground"><static>true</static><link name="l"><collision name="c"><geometry><plane/></geometry>'
        f'</collision></link></model><model name="cart">{body}{parts}{plugin}</model></world></sdf>'
    )


@pytest.mark.parametrize(
    "filename", ["libWheelSlipPlugin.so", "libgazebo_ros_wheel_slip.so", "gz-sim-wheel-slip-system"]
)
def test_a_cart_drifts_down_a_side_slope(tmp_path: Path, filename: str) -> None:
    slope, compliance, speed = 0.1, 0.8, 0.5  # rad, , m/s
    # As on a plane that is tilted about the way: gravity has a part to the side.
    gravity = f"0 {9.81 * math.sin(slope)} {-9.81 * math.cos(slope)}"
    (tmp_path / "w.sdf").write_text(cart(slip_of(filename, lateral=compliance), gravity))
    simulation = bubblesim.Simulation(str(tmp_path / "w.sdf"))
    GazeboPlugins(simulation, None)
    for name in WHEELS:
        axle = simulation.object(f"/cart/{name}_axle")
        axle.motor_mode = bubblesim.MotorMode.VELOCITY
        axle.target_velocity = speed / RADIUS
    simulation.step(40)
    ahead, aside, _ = (float(v) for v in simulation.object("/cart").linear_velocity)
    # The force to the side is m g sin(slope), against 4 loads as the file has them.
    assert aside / ahead == pytest.approx(compliance * MASS * 9.81 * math.sin(slope) / (4 * LOAD), rel=0.03)
    assert ahead == pytest.approx(speed, rel=0.02)


def test_what_is_missing_is_named(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    plugin = '<plugin name="slip" filename="WheelSlipPlugin"><wheel link_name="front_l"/></plugin>'
    (tmp_path / "w.sdf").write_text(cart(plugin, "0 0 -9.81"))
    GazeboPlugins(bubblesim.Simulation(str(tmp_path / "w.sdf")), None)
    assert "<wheel_normal_force> is missing: about that on the wheel at rest, N" in capfd.readouterr().err


@pytest.fixture(scope="module")
def peer(run: Callable[..., Any], tmp_path_factory: pytest.TempPathFactory) -> Peer:
    scene = tmp_path_factory.mktemp("slip") / "w.sdf"
    drive = (
        '<plugin name="drive" filename="libDiffDrivePlugin.so"><left_joint>rear_l_axle</left_joint>'
        "<right_joint>rear_r_axle</right_joint></plugin>"
    )
    slope = f"{-9.81 * math.sin(0.1)} 0 {-9.81 * math.cos(0.1)}"  # uphill along x
    scene.write_text(cart(slip_of("gz-sim-wheel-slip-system") + drive, slope))
    found: Peer = run(scene, "--speed", "2").peer
    return found


def test_topics_set_the_compliance_and_have_the_slip(peer: Peer) -> None:
    peer.drive("/cart/cmd_vel", 0.5, 0.0)

    def slips(least: float, most: float) -> Callable[[Message], bool]:
        def holds(message: Message) -> bool:
            return abs(message["z"] - 0.5) < 0.02 and least <= -message["x"] / 0.5 <= most

        return holds

    topic = "/cart/wheel_slip/rear_l"
    peer.wait_for(topic, "geometry_msgs/Vector3", slips(-0.01, 0.01), "no slip")
    peer.publish("/cart/wheel_slip/longitudinal_compliance", "std_msgs/Float64", {"data": 0.5})
    # Two wheels bear the force m g sin(slope); each has the load of a quarter of the weight in the file.
    expected = 0.5 * MASS * 9.81 * math.sin(0.1) / 2 / LOAD
    peer.wait_for(topic, "geometry_msgs/Vector3", slips(0.9 * expected, 1.1 * expected), "the wheel to slip")
