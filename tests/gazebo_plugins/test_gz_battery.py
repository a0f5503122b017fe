# SPDX-License-Identifier: BSD-3-Clause
"""gz-sim's LinearBatteryPlugin: its voltage and charge against theory, and what an empty one switches off."""

import math
from collections.abc import Callable
from typing import Any

import pytest

from bubblesim.gazebo_plugins.sensors.gz_battery import LinearBattery
from ros_peer import Message, Messages, Peer

STATE = "sensor_msgs/BatteryState"
CHARGING, DISCHARGING, FULL = 1, 2, 4


@pytest.mark.parametrize("step", [0.001, 0.05])
def test_the_charge_is_the_integral_of_a_current_that_approaches_that_of_the_load(step: float) -> None:
    battery = LinearBattery(12.0, 0.0, capacity=1.0, charge=1.0, resistance=0.0, smoothing=2.0, voltage=12.0)
    for _ in range(round(5.0 / step)):
        battery.draw(24.0, 0.0, step)
    current, done = 24.0 / 12.0, 1.0 - math.exp(-5.0 / 2.0)
    assert battery.current == pytest.approx(current * done, rel=1e-9)
    assert battery.charge == pytest.approx(1.0 - current * (5.0 - 2.0 * done) / 3600.0, rel=1e-9)


def test_the_voltage_is_linear_in_the_charge_before_a_resistance() -> None:
    battery = LinearBattery(12.0, -3.0, capacity=2.0, charge=1.0, resistance=0.1, smoothing=1e-3, voltage=12.0)
    for _ in range(100):
        battery.draw(50.0, 0.0, 0.01)
    # V = E - r P / V, with E = 12 - 3 (1 - charge / capacity).
    source = 12.0 - 3.0 * (1.0 - battery.charge / 2.0)
    assert battery.voltage == pytest.approx((source + math.sqrt(source**2 - 4 * 0.1 * 50.0)) / 2, rel=1e-5)
    assert battery.current == pytest.approx(50.0 / battery.voltage, rel=1e-5)


def test_charging_takes_the_charging_time() -> None:
    battery = LinearBattery(12.0, 0.0, capacity=2.0, charge=0.0, resistance=0.0, smoothing=0.1, voltage=12.0)
    for _ in range(3600):
        battery.draw(0.0, 2.0 / 4.0, 1.0)  # a quarter of it in an hour
    assert battery.charge == pytest.approx(0.5, rel=1e-3)


def robot(name: str, battery: str, speed: float) -> str:
    body = "<inertial><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial>"
    return f"""<model name="{name}"><pose>0 {len(name)} 0 0 0 0</pose><link name="body">{body}</link>
    <link name="disc">{body}</link><joint name="foot" type="fixed"><parent>world</parent><child>body</child></joint>
    <joint name="disc_joint" type="revolute"><parent>body</parent><child>disc</child><axis><xyz>0 0 1</xyz>
    <dynamics><damping>5</damping></dynamics></axis></joint>
    <plugin filename="gz-sim-joint-controller-system" name="turn"><joint_name>disc_joint</joint_name>
    <initial_velocity>{speed}</initial_velocity></plugin>
    <plugin filename="gz-sim-joint-state-publisher-system" name="states"><topic>{name}/joints</topic></plugin>
    <plugin filename="gz-sim-linearbatteryplugin-system" name="gz::sim::systems::LinearBatteryPlugin">
    <battery_name>main</battery_name><voltage>12.5</voltage>
    <open_circuit_voltage_constant_coef>12.5</open_circuit_voltage_constant_coef>
    <open_circuit_voltage_linear_coef>-2</open_circuit_voltage_linear_coef><resistance>0.05</resistance>
    <smooth_current_tau>0.1</smooth_current_tau>{battery}</plugin></model>"""


@pytest.fixture(scope="module")
def running(run: Callable[..., Any], tmp_path_factory: pytest.TempPathFactory) -> Any:
    scene = tmp_path_factory.mktemp("battery") / "w.sdf"
    resting = "<capacity>2</capacity><power_load>100</power_load><power_draining_topic>/go</power_draining_topic>"
    small = (
        "<capacity>0.1</capacity><initial_charge>0.02</initial_charge><power_load>200</power_load>"
        "<enable_recharge>true</enable_recharge><charging_time>0.001</charging_time>"
    )
    wrong = "<capacity>1</capacity><initial_charge>1.5</initial_charge>"
    models = robot("resting", resting, 0.0) + robot("turning", small, 2.0) + robot("mistaken", wrong, 0.0)
    scene.write_text(f'<sdf version="1.9"><world name="w">{models}</world></sdf>')
    return run(scene, "--speed", "4", "--gazebo-compat")


def test_a_battery_drains_after_a_message_on_its_topic(running: Any) -> None:
    peer: Peer = running.peer
    first = peer.next("/model/resting/battery/main/state", STATE)
    expected = {"voltage": 12.5, "charge": 2.0, "capacity": 2.0, "percentage": 1.0, "power_supply_status": FULL}
    assert {name: first[name] for name in expected} == pytest.approx(expected)
    peer.drive("/go", 0.1, 0.0)

    def drains(state: Message) -> bool:
        return bool(state["power_supply_status"] == DISCHARGING and state["charge"] < 1.99)

    state = peer.wait_for("/model/resting/battery/main/state", STATE, drains, "the battery to drain")
    assert state["current"] == pytest.approx(100.0 / state["voltage"], rel=1e-3)
    source = 12.5 - 2.0 * (1.0 - state["percentage"])
    assert state["voltage"] == pytest.approx(source - 0.05 * state["current"], rel=1e-4)


def test_an_empty_battery_switches_the_motors_off_until_it_is_charged(running: Any) -> None:
    peer: Peer = running.peer
    topic = "/model/turning/battery/main/state"

    def wait(speed: float) -> None:
        def turns(states: Message) -> bool:
            return bool(states["velocity"][states["name"].index("disc_joint")] == pytest.approx(speed, abs=0.01))

        peer.wait_for("/turning/joints", "sensor_msgs/JointState", turns, f"the disc to turn at {speed} rad/s")

    peer.wait_for(topic, STATE, lambda state: state["charge"] == 0.0, "the battery to be empty")
    wait(0.0)
    peer.publish("/model/turning/battery/main/recharge/start", "std_msgs/Bool", {"data": True})
    peer.wait_for(topic, STATE, lambda state: state["power_supply_status"] == CHARGING, "the battery to charge")
    wait(2.0)


def test_a_reset_charges_it_and_switches_the_motors_on(running: Any) -> None:
    peer: Peer = running.peer
    topic = "/model/turning/battery/main/state"
    peer.publish("/model/turning/battery/main/recharge/stop", "std_msgs/Bool", {"data": True})
    peer.wait_for(topic, STATE, lambda state: state["charge"] == 0.0, "the battery to be empty")
    charges, joints = Messages(peer, topic, STATE), Messages(peer, "/turning/joints", "sensor_msgs/JointState")
    peer.call("/gazebo/reset_world")  # the charge is for 4.5 s
    charges.next(lambda state: 0.0 < state["charge"] < 0.02, "the battery to have charge")

    def turns(states: Message) -> bool:
        return bool(states["velocity"][states["name"].index("disc_joint")] == pytest.approx(2.0, abs=0.01))

    joints.next(turns, "the disc to turn again")


def test_a_charge_above_the_capacity_is_reported(running: Any) -> None:
    assert "is 1.5 Ah, it must be at most <capacity>, 1" in running.node.output
