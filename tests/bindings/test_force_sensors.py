# SPDX-License-Identifier: BSD-3-Clause
"""Contact and force-torque sensors, compared with weights and levers."""

from pathlib import Path

import numpy as np
import pytest

import bubblesim
from node_support import run_script, write

G = 9.8  # m/s^2, SDFormat's default
BOX = """<inertial><mass>2</mass><inertia><ixx>0.02</ixx><iyy>0.02</iyy><izz>0.02</izz></inertia></inertial>
  <collision name="sole"><geometry><box><size>0.4 0.4 0.1</size></box></geometry></collision>"""


def world(folder: Path, models: str) -> bubblesim.Simulation:
    file = write(
        folder / "scene.sdf",
        f"""\
        <?xml version="1.0"?>
        <sdf version="1.9"><world name="w">
          <model name="Ground"><static>true</static><link name="link">
            <collision name="plane"><geometry><plane><normal>0 0 1</normal></plane></geometry></collision>
          </link></model>
          {models}
        </world></sdf>""",
    )
    return bubblesim.Simulation(str(file))


def box(height: float, sensor: str = "") -> str:
    return f"""<model name="Box"><pose>0 0 {height} 0 0 0</pose><link name="link">{BOX}
      <sensor name="Bumper" type="contact">{sensor}</sensor></link></model>"""


def test_a_resting_box_measures_its_weight(tmp_path: Path) -> None:
    simulation = world(tmp_path, box(0.05))
    simulation.step(40)
    (contact,) = simulation.object("/Bumper").reading.contacts
    assert (contact.collision, contact.other_collision) == ("sole", "plane")
    assert contact.other == simulation.object("/Ground/link").handle
    np.testing.assert_allclose(contact.force, [0, 0, 2 * G], atol=1e-3)
    assert len(contact.points) >= 3  # corners
    np.testing.assert_allclose(sum(point.force for point in contact.points), contact.force, atol=1e-2)
    for point in contact.points:
        np.testing.assert_allclose(point.normal, [0, 0, 1], atol=1e-6)
        np.testing.assert_allclose(np.abs(point.position), [0.2, 0.2, 0.0], atol=2e-3)
        assert 0 <= point.depth < 2e-3


def test_in_the_air_nothing_is_touched_and_an_impact_between_two_looks_is_not_missed(tmp_path: Path) -> None:
    simulation = world(tmp_path, box(0.5))
    bumper = simulation.object("/Bumper")
    felt = np.zeros(3)
    for _ in range(30):
        simulation.step()
        felt += sum((contact.force for contact in bumper.reading.contacts), np.zeros(3)) * simulation.time_step
        if simulation.time < 0.25:  # it falls 0.45 m in 0.3 s
            assert bumper.reading.contacts == []
    # The impulse that stopped and held it equals the impulse of gravity.
    np.testing.assert_allclose(felt, [0, 0, 2 * G * simulation.time], rtol=0.01, atol=1e-6)


def test_only_the_collisions_named_are_felt(tmp_path: Path) -> None:
    side = """<collision name="side"><pose>0 0 2 0 0 0</pose><geometry><sphere><radius>0.1</radius></sphere></geometry>
      </collision></link>"""
    only_side = "<contact><collision>side</collision></contact>"
    simulation = world(tmp_path, box(0.05, only_side).replace("</link>", side))
    simulation.step(20)
    assert simulation.object("/Bumper").reading.contacts == []


def test_a_static_plate_measures_what_lies_on_it(tmp_path: Path) -> None:
    plate = """<model name="Plate"><static>true</static><pose>0 0 1 0 0 0</pose><link name="link">
      <collision name="top"><geometry><box><size>1 1 0.1</size></box></geometry></collision>
      <sensor name="Scale" type="contact"><contact><collision>top</collision></contact></sensor></link></model>"""
    simulation = world(tmp_path, plate + box(1.1))
    simulation.step(40)
    (contact,) = simulation.object("/Scale").reading.contacts
    np.testing.assert_allclose(contact.force, [0, 0, -2 * G], atol=1e-3)
    assert contact.other == simulation.object("/Box/link").handle
    np.testing.assert_allclose(contact.points[0].normal, [0, 0, -1], atol=1e-6)


def arm(joint: str, sensor: str = "", roll: float = 0.0) -> str:
    """3 kg, half a metre along x from the joint, which is in the arm's frame 2 m above the ground."""
    return f"""<model name="Arm"><pose>0 0 2 {roll} 0 0</pose>
      <link name="base"><inertial><mass>1</mass></inertial></link>
      <link name="arm"><inertial><pose>0.5 0 0 0 0 0</pose><mass>3</mass>
        <inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial></link>
      <joint name="foot" type="fixed"><parent>world</parent><child>base</child></joint>
      <joint name="joint" type="{joint}"><pose relative_to="base"/><parent>base</parent><child>arm</child>
        {"<axis><xyz>0 1 0</xyz><dynamics><damping>5</damping></dynamics></axis>" if joint == "revolute" else ""}
        <sensor name="Force" type="force_torque">{sensor}</sensor></joint></model>"""


def test_a_fixed_arm_pulls_and_bends(tmp_path: Path) -> None:
    simulation = world(tmp_path, arm("fixed"))
    simulation.step(10)
    reading = simulation.object("/Force").reading
    np.testing.assert_allclose(reading.force, [0, 0, -3 * G], atol=1e-3)
    # (0.5, 0, 0) x (0, 0, -3 g)
    np.testing.assert_allclose(reading.torque, [0, 0.5 * 3 * G, 0], atol=1e-3)


@pytest.mark.parametrize(
    ("sensor", "force", "torque"),
    [
        ("<force_torque><measure_direction>parent_to_child</measure_direction></force_torque>", [0, 3, 0], [0, 0, 1.5]),
        ("<force_torque><frame>parent</frame></force_torque>", [0, -3, 0], [0, 0, -1.5]),
        (
            "<pose>0 0 0 0 0 1.5707963267948966</pose><force_torque><frame>sensor</frame></force_torque>",
            [-3, 0, 0],
            [0, 0, -1.5],
        ),
        ("<pose>0.5 0 0 0 0 0</pose>", [0, -3, 0], [0, 0, 0]),
    ],
    ids=["what the parent does", "axes of the parent", "axes of the sensor", "about the sensor"],
)
def test_frames_and_direction_are_as_described(
    tmp_path: Path, sensor: str, force: list[float], torque: list[float]
) -> None:
    # Rolled by a quarter turn to the right, down is -y of the arm.
    simulation = world(tmp_path, arm("fixed", sensor, roll=np.pi / 2))
    simulation.step(10)
    reading = simulation.object("/Force").reading
    np.testing.assert_allclose(reading.force, np.array(force) * G, atol=1e-3)
    np.testing.assert_allclose(reading.torque, np.array(torque) * G, atol=1e-3)


def test_a_pendulum_at_rest_only_pulls(tmp_path: Path) -> None:
    simulation = world(tmp_path, arm("revolute"))
    simulation.step(600)
    reading = simulation.object("/Force").reading
    # It hangs: its x axis points down.
    np.testing.assert_allclose(reading.force, [3 * G, 0, 0], atol=0.05)
    np.testing.assert_allclose(reading.torque, [0, 0, 0], atol=0.05)


def test_scripts_read_them_and_distinguish_kinds(tmp_path: Path) -> None:
    world(tmp_path, box(0.05) + arm("fixed"))
    run = run_script(
        tmp_path,
        """\
        def sysCall_init():
            pass

        def sysCall_sensing():
            if sim.getSimulationTime() < 1.0:
                return
            (contact,) = sim.readContacts(sim.getObject('/Bumper'))
            assert abs(contact['force'][2] - 2 * 9.8) < 0.01, contact
            assert contact['other'] == sim.getObject('/Ground/link')
            assert contact['normals'][0] == [0, 0, 1] and len(contact['positions']) == len(contact['normals'])
            result, force, torque = sim.readForceSensor(sim.getObject('/Force'))
            assert result == 1 and abs(force[2] + 3 * 9.8) < 0.01 and abs(torque[1] - 1.5 * 9.8) < 0.01
            assert sim.getObjectType(sim.getObject('/Force')) == sim.object_forcesensor_type
            assert sim.getObjectType(sim.getObject('/Bumper')) == sim.object_dummy_type
            assert sim.getObjectType(sim.getObject('/joint')) == sim.object_joint_type
        """,
        "--strict",
        scene=str(tmp_path / "scene.sdf"),
        target="/Box",
        until=1.2,
    )
    assert (run.stderr, run.returncode) == ("", 0)
