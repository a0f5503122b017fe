# SPDX-License-Identifier: BSD-3-Clause
"""A world's <bubblesim:solver>: refused values, states that continue, and random trees beside ODE."""

import math
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

import bubblesim


def write_world(file: Path, solver: str, models: str, step: float = 0.005) -> Path:
    file.write_text(f"""\
<sdf version="1.9" xmlns:bubblesim="https://bubblesim">
  <world name="w">
    <gravity>0 0 -9.81</gravity>
    <physics type="ode">
      <max_step_size>{step}</max_step_size>
      <bubblesim:solver>{solver}</bubblesim:solver>
    </physics>
    {models}
  </world>
</sdf>
""")
    return file


def tree(random: np.random.Generator, links: int) -> str:
    """Return a model of bodies that hang at random joints from random bodies before them; the first from the world."""
    parts = []
    for number in range(links):
        mass = random.uniform(0.5, 2.0)
        inertia = np.sort(random.uniform(0.02, 0.03, 3))  # the largest is below the sum of the others
        place = " ".join(map(str, random.uniform(-0.3, 0.3, 3) + np.array([0, 0, 2])))
        turn = " ".join(map(str, random.uniform(-1, 1, 3)))
        centre = " ".join(map(str, random.uniform(-0.1, 0.1, 3)))
        parts.append(f"""
    <link name="link{number}"><pose>{place} {turn}</pose>
      <inertial><pose>{centre} 0 0 0</pose><mass>{mass}</mass>
        <inertia><ixx>{inertia[0]}</ixx><iyy>{inertia[1]}</iyy><izz>{inertia[2]}</izz></inertia></inertial></link>""")
        if number == 0:
            parts.append('<joint name="root" type="ball"><parent>world</parent><child>link0</child></joint>')
            continue
        kind = random.choice(["revolute", "prismatic", "ball", "universal", "fixed"])
        axes = random.normal(size=3), random.normal(size=3)
        second = np.cross(axes[0], axes[1])  # a universal joint's axes are at right angles
        written = [f"<xyz>{' '.join(map(str, axis / np.linalg.norm(axis)))}</xyz>" for axis in (axes[0], second)]
        axis = f"<axis>{written[0]}</axis>" if kind in ("revolute", "prismatic", "universal") else ""
        axis2 = f"<axis2>{written[1]}</axis2>" if kind == "universal" else ""
        parts.append(f"""
    <joint name="joint{number}" type="{kind}"><parent>link{random.integers(number)}</parent>
      <child>link{number}</child>{axis}{axis2}</joint>""")
    return f'<model name="tree">{"".join(parts)}</model>'


def places_after(file: Path, seconds: float) -> npt.NDArray[np.float64]:
    """Return where the bodies of the tree are, n x 3, in m."""
    simulation = bubblesim.Simulation(str(file))
    simulation.step(round(seconds / simulation.time_step))
    assert simulation.time == pytest.approx(seconds)
    return np.array([body.position for body in simulation.objects if "link" in body.name])


def test_a_solver_that_does_not_exist_is_reported_with_its_line_and_those_that_do(tmp_path: Path) -> None:
    file = write_world(tmp_path / "w.sdf", "bublesim", "")
    with pytest.raises(Exception, match=r"w.sdf:6.*'bublesim', it must be ode or bubblesim.*did you mean.*bubblesim"):
        bubblesim.Simulation(str(file))


@pytest.mark.parametrize("seed", range(12))
def test_random_trees_move_as_with_ode(tmp_path: Path, seed: int) -> None:
    models = tree(np.random.default_rng(seed), 6)
    largest = []  # difference of a place, m
    for step in (1e-3, 2.5e-4):
        files = [write_world(tmp_path / f"{solver}.sdf", solver, models, step) for solver in ("ode", "bubblesim")]
        ode, ours = (places_after(file, 0.5) for file in files)
        assert np.ptp(ode, axis=0).max() > 0.1
        largest.append(np.abs(ode - ours).max())
    # Both are of first order at least: a quarter of the step leaves a quarter of the difference, or less.
    assert largest[1] < 1e-3
    assert largest[1] < 0.3 * largest[0]


def driving() -> bubblesim.Simulation:
    """Return a tricycle that drives a curve."""
    simulation = bubblesim.Simulation("tricycle", seed=3)
    drive(simulation)
    return simulation


def drive(simulation: bubblesim.Simulation) -> None:
    simulation.object("/FrontMotor").target_velocity = 3.0
    simulation.object("/Steering").target_position = 0.3
    simulation.step(15)


def test_a_saved_state_continues_bit_for_bit() -> None:
    simulation = driving()
    saved, scene = simulation.save(), simulation.scene_file
    simulation.step(20)
    other = bubblesim.Simulation(str(scene), seed=99)
    other.restore(saved)
    other.step(20)
    assert other.state_hash() == simulation.state_hash()


def test_a_reset_repeats_the_run_bit_for_bit() -> None:
    simulation = driving()
    first = simulation.state_hash()
    simulation.step(20)
    simulation.reset()
    drive(simulation)
    assert simulation.state_hash() == first


def test_a_tricycle_turns_about_the_centre_of_its_wheels() -> None:
    """Without slip its rear axle has the radius L / tan(a) and the yaw rate v sin(a) / L.

    The wheelbase L is 1 m, the steering angle a, the speed of the front wheel v. Rows are those of the pose before a
    substep: the direction of motion is half a substep behind, a turn of e = w h / 2 = 6.6e-4 rad, which adds e c to the
    radius, 2.7e-4 m for the centre of mass c = 0.4 m before the axle.
    """
    simulation = driving()
    simulation.step(25)
    tricycle = simulation.object("/Tricycle")
    angle, speed = simulation.object("/Steering").joint_position, 3.0 * 0.3
    places = []
    for _ in range(60):
        simulation.step()
        places.append(tricycle.position[:2])
        assert tricycle.angular_velocity[2] == pytest.approx(speed * math.sin(angle), rel=1e-5)
    points = np.array(places)  # on a circle about m: p.p = 2 m.p + r^2 - m.m
    rows = np.column_stack((2 * points, np.ones(len(points))))
    x, y, rest = np.linalg.lstsq(rows, (points**2).sum(axis=1), rcond=None)[0]
    assert math.sqrt(rest + x * x + y * y) == pytest.approx(1.0 / math.tan(angle), abs=4e-4)
