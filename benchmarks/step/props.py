# SPDX-License-Identifier: BSD-3-Clause
"""Compare physics substeps of bodies without joints with MuJoCo: a tower, a pile, and boxes that sleep around a robot.

    python benchmarks/step/props.py [--rounds N]

Needs the workspace and `pip install -r benchmarks/requirements.txt`. The candidates run alternately in every round, so
that other load affects them equally; the table shows medians over the rounds.
"""

from __future__ import annotations

import argparse
import tempfile

import mujoco
import numpy as np
from peers import Ours as Tricycles
from peers import medians

import bubblesim

STEP = 0.005  # s
SUBSTEPS = 10  # in a step of bubblesim
SIZE, DENSITY = 0.2, 500.0  # of a box: m, kg/m^3
MASS = DENSITY * SIZE**3  # kg
TURNING = MASS * SIZE**2 / 6  # kg m^2
SETTLING = 1000  # substeps, until a pile rests
SLEEPERS = 1000

Places = list[tuple[float, float, float]]


def tower(count: int) -> Places:
    """Return boxes on each other."""
    return [(0, 0, (i + 0.5) * SIZE) for i in range(count)]


def pile(count: int) -> Places:
    """Return boxes that fall on each other, in layers of 25 with gaps."""
    rng = np.random.default_rng(7)
    found = []
    for i in range(count):
        x, y = rng.uniform(-0.05, 0.05, 2)
        found.append(((i % 5 - 2) * 1.4 * SIZE + x, (i // 5 % 5 - 2) * 1.4 * SIZE + y, (i // 25 + 0.6) * 1.3 * SIZE))
    return found


def sleepers(count: int) -> str:
    """Return boxes on the floor, 5 m and more away from the origin."""
    places = [(6 + 0.5 * (i % 40), 6 + 0.5 * (i // 40), SIZE / 2) for i in range(count)]
    return "".join(box_model(f"Box{i}", place) for i, place in enumerate(places))


def box_model(name: str, place: tuple[float, float, float], sensor: str = "") -> str:
    """Return a box in SDFormat."""
    return f"""<model name="{name}"><pose>{place[0]} {place[1]} {place[2]} 0 0 0</pose><link name="l">
        <inertial><mass>{MASS}</mass><inertia><ixx>{TURNING}</ixx><iyy>{TURNING}</iyy><izz>{TURNING}</izz></inertia>
        </inertial><collision name="c"><geometry><box><size>{SIZE} {SIZE} {SIZE}</size></box></geometry></collision>
        {sensor}</link></model>"""


class Ours:
    """Boxes in bubblesim, kept awake by a sensor in each."""

    def __init__(self, places: Places) -> None:
        """Load the scene."""
        sensor = '<sensor name="s" type="contact"><contact><collision>c</collision></contact></sensor>'
        models = "".join(box_model(f"Box{i}", place, sensor) for i, place in enumerate(places))
        with tempfile.NamedTemporaryFile("w", suffix=".sdf") as file:
            file.write(f"""<sdf version="1.9"><world name="w"><physics type="ode"><max_step_size>{STEP}</max_step_size>
            </physics><include><uri>model://floor</uri></include>{models}</world></sdf>""")
            file.flush()
            self.simulation = bubblesim.Simulation(file.name)

    def run(self, steps: int) -> None:
        """Run this number of physics substeps."""
        self.simulation.step(steps // SUBSTEPS)


class MuJoCo:
    """The same boxes with MuJoCo's defaults."""

    def __init__(self, places: Places) -> None:
        """Build the model."""
        bodies = "".join(
            f'<body pos="{x} {y} {z}"><freejoint/><geom type="box" size="{SIZE / 2} {SIZE / 2} {SIZE / 2}"'
            f' density="{DENSITY}"/></body>'
            for x, y, z in places
        )
        self.model = mujoco.MjModel.from_xml_string(
            f"""<mujoco><option timestep="{STEP}"/><worldbody><geom type="plane" size="50 50 1"/>{bodies}</worldbody>
            </mujoco>"""
        )
        self.data = mujoco.MjData(self.model)

    def run(self, steps: int) -> None:
        """Run this number of physics substeps."""
        mujoco.mj_step(self.model, self.data, steps)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=7)
    rounds = parser.parse_args().rounds
    for name, places in {"tower of 12": tower(12), "pile of 200": pile(200)}.items():
        candidates = {"bubblesim": Ours(places), "MuJoCo": MuJoCo(places)}
        for candidate in candidates.values():
            candidate.run(SETTLING)
        times = medians({name: candidate.run for name, candidate in candidates.items()}, rounds, 100)
        for candidate_name, took in times.items():
            print(f"{name:14} {candidate_name:10} {took:9.1f} us a substep, {took / times['bubblesim']:6.2f} x")
    robots = {"alone": Tricycles(0), "with sleepers": Tricycles(0, more=sleepers(SLEEPERS))}
    for robot in robots.values():
        robot.run(SETTLING)
    times = medians({name: robot.run for name, robot in robots.items()}, rounds)
    for name, took in times.items():
        print(f"tricycle {name:14} {took:9.2f} us a substep, {took / times['alone']:6.2f} x")


if __name__ == "__main__":
    main()
