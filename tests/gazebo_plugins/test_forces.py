# SPDX-License-Identifier: BSD-3-Clause
"""Plugins that push links, as read from files; their forces are compared with theory in tests/sim/devices."""

import math
from collections.abc import Callable
from pathlib import Path

import pytest

import bubblesim
from bubblesim.gazebo_plugins.robots import GazeboPlugins

Load = Callable[..., bubblesim.Simulation]

BALL = """<inertial><mass>2</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>
<collision name="ball"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>"""
VOLUME = 4 / 3 * math.pi * 0.001
PROPELLER = """<link name="frame"/><link name="blades"/>
<joint name="spindle" type="revolute"><parent>frame</parent><child>blades</child>
<axis><xyz>0 0 1</xyz></axis></joint>"""


def plugin(filename: str, parameters: str) -> str:
    return f'<plugin name="it" filename="{filename}">{parameters}</plugin>'


@pytest.fixture
def load(tmp_path: Path) -> Load:
    """Load a model, in a world with further elements, with the plugins that act without ROS."""

    def simulate(model: str, world: str = "", gravity: str = "0 0 -9.81") -> bubblesim.Simulation:
        file = tmp_path / "scene.sdf"
        file.write_text(
            f'<sdf version="1.9"><world name="w"><gravity>{gravity}</gravity>{world}'
            f'<model name="Robot"><pose>0 0 -5 0 0 0</pose>{model}</model></world></sdf>'
        )
        simulation = bubblesim.Simulation(str(file))
        GazeboPlugins(simulation, None)
        return simulation

    return simulate


def acceleration(simulation: bubblesim.Simulation) -> list[float]:
    """Return that of the first step, m/s^2."""
    simulation.step()
    return [float(v) / simulation.time_step for v in simulation.object("/Robot").linear_velocity]


def test_buoyancy_of_the_whole_world(load: Load) -> None:
    water = plugin("gz-sim-buoyancy-system", "<uniform_fluid_density>500</uniform_fluid_density>")
    simulation = load(f'<link name="link">{BALL}</link>', water)
    assert acceleration(simulation)[2] == pytest.approx(9.81 * (500 * VOLUME / 2 - 1), rel=1e-6)


@pytest.mark.parametrize(("height", "density"), [(-5, 1000), (2, 1.2), (20, 0.5)])
def test_buoyancy_in_layers(load: Load, height: float, density: float) -> None:
    layers = """<graded_buoyancy><default_density>1000</default_density>
      <density_change><above_depth>10</above_depth><density>0.5</density></density_change>
      <density_change><above_depth>0</above_depth><density>1.2</density></density_change></graded_buoyancy>"""
    simulation = load(f'<link name="link">{BALL}</link>', plugin("ignition-gazebo-buoyancy-system", layers))
    simulation.object("/Robot").position = [0, 0, height]
    assert acceleration(simulation)[2] == pytest.approx(9.81 * (density * VOLUME / 2 - 1), rel=1e-6)


def test_buoyancy_of_the_named_models_only(load: Load) -> None:
    water = plugin("gz-sim-buoyancy-system", "<enable>Other::link</enable>")
    assert acceleration(load(f'<link name="link">{BALL}</link>', water))[2] == pytest.approx(-9.81)


def test_buoyancy_of_a_model(load: Load) -> None:
    simulation = load(f'<link name="link">{BALL}</link>' + plugin("libBuoyancyPlugin.so", ""))
    assert acceleration(simulation)[2] == pytest.approx(9.81 * (999.1026 * VOLUME / 2 - 1), rel=1e-6)


def test_buoyancy_of_a_model_with_a_volume(load: Load) -> None:
    volume = """<fluid_density>1000</fluid_density><link name="link">
      <center_of_volume>0 0 0</center_of_volume><volume>0.003</volume></link>"""
    simulation = load(f'<link name="link">{BALL}</link>' + plugin("libBuoyancyPlugin.so", volume))
    assert acceleration(simulation)[2] == pytest.approx(9.81 * (3 / 2 - 1), rel=1e-6)


def test_hydrodynamics_slow_a_link_relative_to_the_current(load: Load, capfd: pytest.CaptureFixture[str]) -> None:
    parameters = """<link_name>link</link_name><xU>3</xU><xUU>2</xUU><yV>0</yV><zW>0</zW><xDotU>5</xDotU>
      <default_current>1 0 0</default_current>"""
    drag = plugin("gz-sim-hydrodynamics-system", parameters)
    simulation = load(f'<link name="link">{BALL}</link>{drag}', gravity="0 0 0")
    simulation.set_time_step(0.001)
    assert acceleration(simulation)[0] == pytest.approx((3 + 2) / 2, rel=1e-3)
    assert "<xDotU>: added mass is not simulated" in capfd.readouterr().err


def test_lift_and_drag_of_a_wing(load: Load) -> None:
    wing = """<link_name>link</link_name><area>0.2</area><air_density>1</air_density><a0>0.1</a0><cla>3</cla>
      <cda>0.5</cda><cma>1</cma>"""
    simulation = load(f'<link name="link">{BALL}</link>' + plugin("libLiftDragPlugin.so", wing), gravity="0 0 0")
    simulation.set_time_step(0.001)
    simulation.object("/Robot").linear_velocity = [10, 0, 0]
    simulation.step()
    change = (simulation.object("/Robot").linear_velocity - [10, 0, 0]) / 0.001
    pressure = 0.5 * 1 * 100 * 0.2
    assert list(change) == pytest.approx([-0.05 * pressure / 2, 0, 0.3 * pressure / 2], rel=1e-3)


def test_a_motor_turns_its_propeller_and_pushes(load: Load) -> None:
    motor = """<jointName>spindle</jointName><linkName>blades</linkName><turningDirection>cw</turningDirection>
      <motorNumber>0</motorNumber><motorConstant>1e-5</motorConstant><timeConstantUp>0</timeConstantUp>"""
    simulation = load(PROPELLER + plugin("librotors_gazebo_motor_model.so", motor), gravity="0 0 0")
    simulation.object("/Robot/spindle").target_velocity = -50
    simulation.step()
    before = simulation.object("/Robot").linear_velocity[2]
    simulation.step()
    change = (simulation.object("/Robot").linear_velocity[2] - before) / simulation.time_step
    assert change == pytest.approx(1e-5 * 500**2 / 2, rel=1e-3)
    assert simulation.object("/Robot/spindle").joint_velocity == pytest.approx(-50, rel=1e-3)


def test_wind_pushes_links_and_rises(load: Load) -> None:
    world = "<wind><linear_velocity>4 0 0</linear_velocity></wind>" + plugin(
        "gz-sim-wind-effects-system",
        """<force_approximation_scaling_factor>0.5</force_approximation_scaling_factor>
        <horizontal><magnitude><time_for_rise>2</time_for_rise></magnitude></horizontal>""",
    )
    simulation = load(f"<enable_wind>true</enable_wind><link name='link'>{BALL}</link>", world, gravity="0 0 0")
    simulation.step(round(2 / simulation.time_step))
    # v' = 0.5 (4 (1 - exp(-t/2)) - v): v = 4 - 4 exp(-t/2) (1 + t/2)
    assert simulation.object("/Robot").linear_velocity[0] == pytest.approx(4 - 8 * math.exp(-1), rel=5e-3)
    assert simulation.wind.velocity[0] == pytest.approx(4 * (1 - math.exp(-1)), rel=1e-6)


@pytest.mark.parametrize(
    ("model", "world", "text"),
    [
        (
            PROPELLER + plugin("gz-sim-multicopter-motor-model-system", "<jointName>spindle</jointName>"),
            "",
            "plugin 'it': <turningDirection> is missing, it must be cw or ccw",
        ),
        (
            PROPELLER
            + plugin(
                "gz-sim-multicopter-motor-model-system",
                "<jointName>spindel</jointName><turningDirection>cw</turningDirection>",
            ),
            "",
            "<jointName> is 'spindel', which is not a joint of /Robot",
        ),
        (
            PROPELLER
            + plugin(
                "gz-sim-multicopter-motor-model-system",
                "<jointName>spindle</jointName><turningDirection>left</turningDirection><motorType>force</motorType>",
            ),
            "",
            "<turningDirection> is 'left', it must be cw or ccw",
        ),
        (
            f'<link name="link">{BALL}</link>' + plugin("gz-sim-lift-drag-system", "<area>-1</area>"),
            "",
            "<link_name> is '', which is not a link of /Robot",
        ),
        (
            f'<link name="link">{BALL}</link>'
            + plugin("gz-sim-lift-drag-system", "<link_name>link</link_name><area>-1</area>"),
            "",
            "<area> is '-1', it must be a number of at least 0",
        ),
        (
            f'<link name="link">{BALL}</link>',
            plugin(
                "gz-sim-wind-effects-system",
                "<horizontal><magnitude><time_for_rise>0</time_for_rise></magnitude></horizontal>",
            ),
            "<time_for_rise> is '0', it must be a number above 0",
        ),
        (
            f'<link name="link">{BALL}</link>' + plugin("gz-sim-buoyancy-system", ""),
            "",
            "is ignored: it must be in the <world>, not in a <model>",
        ),
        (
            f'<link name="link">{BALL}</link>',
            plugin("gz-sim-hydrodynamics-system", ""),
            "is ignored: it must be in a <model>, not in the <world>",
        ),
    ],
)
def test_bad_parameters_are_reported(
    load: Load, capfd: pytest.CaptureFixture[str], model: str, world: str, text: str
) -> None:
    load(model, world)
    assert text in capfd.readouterr().err
