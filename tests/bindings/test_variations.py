# SPDX-License-Identifier: BSD-3-Clause
"""What can differ between simulations of a scene: gain of motors, noise of sensors, brightness of lights."""

from pathlib import Path

import numpy as np
import pytest

from bubblesim import Batch, Distribution, Simulation

DEVIATION = 0.02  # m
SCENE = f"""\
<sdf version="1.9"><world name="w">
  <gravity>0 0 0</gravity>
  <scene><ambient>0.2 0.2 0.2</ambient><shadows>false</shadows></scene>
  <light name="sun" type="directional"><direction>1 0 0</direction><diffuse>0.5 0.5 0.5</diffuse></light>
  <model name="wall"><static>true</static><pose>3 0 0 0 0 0</pose><link name="link">
    <collision name="c"><geometry><box><size>0.2 20 20</size></box></geometry></collision>
    <visual name="v"><geometry><box><size>0.2 20 20</size></box></geometry>
      <material><diffuse>0.6 0.6 0.6</diffuse><ambient>0.6 0.6 0.6</ambient></material></visual>
  </link></model>
  <model name="eye"><static>true</static><link name="link">
    <sensor name="lidar" type="gpu_lidar"><lidar>
      <scan><horizontal><samples>2000</samples><min_angle>-0.01</min_angle><max_angle>0.01</max_angle></horizontal></scan>
      <range><min>0.1</min><max>10</max></range>
      <noise><type>gaussian</type><stddev>{DEVIATION}</stddev></noise>
    </lidar></sensor>
    <sensor name="camera" type="camera"><camera>
      <horizontal_fov>0.5</horizontal_fov><image><width>8</width><height>8</height></image>
    </camera></sensor>
  </link></model>
  <model name="wheel"><pose>0 3 0 0 0 0</pose>
    <link name="base"><inertial><mass>100</mass></inertial></link>
    <link name="disc"><inertial><mass>1</mass></inertial></link>
    <joint name="hinge" type="revolute"><parent>base</parent><child>disc</child><axis><xyz>0 0 1</xyz></axis></joint>
  </model>
</world></sdf>
"""


@pytest.fixture
def scene(tmp_path: Path) -> str:
    file = tmp_path / "scene.sdf"
    file.write_text(SCENE)
    return str(file)


def deviation(simulation: Simulation) -> float:
    simulation.step()
    ranges = simulation.object("/eye/link/lidar").reading.ranges
    return float(np.std(ranges))


@pytest.mark.parametrize("scale", [0.0, 1.0, 3.0])
def test_noise_has_its_deviation_times_the_scale(scene: str, scale: float) -> None:
    simulation = Simulation(scene)
    simulation.object("/eye/link/lidar").noise_scale = scale
    # 2000 samples: the standard deviation of a deviation is 1 / sqrt(4000)
    assert deviation(simulation) == pytest.approx(scale * DEVIATION, rel=5 / 4000**0.5, abs=1e-4)


@pytest.mark.parametrize("brightness", [0.0, 0.5, 1.0, 1.2])
def test_colours_are_proportional_to_the_brightness(scene: str, brightness: float) -> None:
    simulation = Simulation(scene)
    simulation.brightness = brightness
    simulation.step()
    image = simulation.object("/eye/link/camera").reading.rgb
    # Lambert's law: diffuse of the surface times (diffuse of the light, at a right angle, and ambient light)
    np.testing.assert_allclose(image, 255 * 0.6 * (0.5 + 0.2) * brightness, atol=1)


@pytest.mark.parametrize("gain", [0.0, 0.5, 1.0, 2.0])
def test_a_motor_turns_with_its_gain_times_the_target(scene: str, gain: float) -> None:
    simulation = Simulation(scene)
    hinge = simulation.object("/wheel/hinge")
    hinge.motor_gain = gain
    hinge.motor_mode = type(hinge.motor_mode).VELOCITY
    hinge.target_velocity = 1.5
    simulation.step(10)
    assert hinge.joint_velocity == pytest.approx(1.5 * gain, abs=1e-6)
    assert hinge.target_velocity == 1.5


def test_an_effort_is_multiplied_and_limited(scene: str) -> None:
    simulation = Simulation(scene)
    hinge = simulation.object("/wheel/hinge")
    hinge.motor_mode = type(hinge.motor_mode).EFFORT
    hinge.motor_gain = 0.5
    hinge.target_effort = 0.4
    simulation.step()
    assert hinge.motor_effort == pytest.approx(0.2, rel=1e-6)
    hinge.max_force = 0.1
    simulation.step()
    assert hinge.motor_effort == pytest.approx(0.1, rel=1e-6)


def test_a_position_is_approached_faster_by_the_gain(scene: str) -> None:
    left = {}
    for gain in (1.0, 0.5):
        simulation = Simulation(scene)
        hinge = simulation.object("/wheel/hinge")
        hinge.motor_mode = type(hinge.motor_mode).POSITION
        hinge.motor_gain = gain
        hinge.target_position = 1.0
        simulation.step(4)
        left[gain] = 1 - hinge.joint_position
    # x' = gain (target - x) / T: what is left falls exponentially
    assert np.log(left[1.0]) / np.log(left[0.5]) == pytest.approx(2, rel=0.06)


def test_a_reset_puts_all_back_and_a_snapshot_keeps_it(scene: str) -> None:
    simulation = Simulation(scene)
    hinge, lidar = simulation.object("/wheel/hinge"), simulation.object("/eye/link/lidar")

    def values() -> list[float]:
        return [hinge.motor_gain, lidar.noise_scale, simulation.brightness]

    hinge.motor_gain, lidar.noise_scale, simulation.brightness = 0.7, 2.0, 0.4
    state = simulation.save()
    simulation.reset()
    assert values() == [1, 1, 1]
    simulation.restore(state)
    assert values() == [0.7, 2.0, 0.4]
    simulation.reset_world()
    assert values() == [1, 1, 1]


def test_they_are_drawn_by_the_seed(scene: str) -> None:
    randomize = {
        "/wheel/hinge.motor_gain": Distribution.uniform(0.8, 1.2),
        "/eye/link/lidar.noise_scale": Distribution.uniform(0, 2),
        "brightness": Distribution.uniform(0.5, 1.5),
    }
    names = list(randomize)
    batch = Batch(scene, 3, seed=4, observations=names, randomize=randomize, dtype="float64")
    assert len(np.unique(batch.observed)) == 9
    alone = Simulation(scene, seed=6)
    alone.randomize(randomize)
    expected = [
        alone.object("/wheel/hinge").motor_gain,
        alone.object("/eye/link/lidar").noise_scale,
        alone.brightness,
    ]
    assert batch.observed[2].tolist() == expected


@pytest.mark.parametrize("value", [-1.0, float("nan"), float("inf")])
def test_what_cannot_be_used_is_refused(scene: str, value: float) -> None:
    simulation = Simulation(scene)
    with pytest.raises(ValueError, match=r"/hinge: the motor gain .* is not usable: it must be from 0 to 1000"):
        simulation.object("/wheel/hinge").motor_gain = value
    with pytest.raises(ValueError, match=r"lidar: the noise scale .* is not usable: it must be 0 or more"):
        simulation.object("/eye/link/lidar").noise_scale = value
    with pytest.raises(ValueError, match=r"the brightness .* is not usable: it must be 0 or more"):
        simulation.brightness = value
