# SPDX-License-Identifier: BSD-3-Clause
"""Compare physics substeps of arms that swing without contacts: both solvers of bubblesim and MuJoCo.

    python benchmarks/step/arms.py [--rounds N]

Needs the workspace and `pip install -r benchmarks/requirements.txt`. The candidates run alternately in every round, so
that other load affects them equally; the table shows medians over the rounds.
"""

from __future__ import annotations

import argparse
import tempfile
from typing import Any

import mujoco
import numpy as np
from peers import medians

import bubblesim

STEP = 0.005  # s
SUBSTEPS = 10  # in a step of bubblesim
LENGTH, WIDTH, MASS = 0.2, 0.05, 0.5  # of a link: m, m, kg
DAMPING = 0.05  # N m s/rad
ALONG = MASS * WIDTH**2 / 6  # kg m^2, moments of inertia of a box
ACROSS = MASS * (LENGTH**2 + WIDTH**2) / 12
AXES = ("0 1 0", "0 0 1")  # of the joints, in turn


class Ours:
    """An arm of bubblesim."""

    def __init__(self, links: int, solver: str) -> None:
        """Load the scene."""
        parts = []
        for i in range(links):
            parent = "world" if i == 0 else f"l{i - 1}"
            parts.append(f"""
        <link name="l{i}"><pose>{(i + 0.5) * LENGTH} 0 20 0 0 0</pose><inertial><mass>{MASS}</mass>
          <inertia><ixx>{ALONG}</ixx><iyy>{ACROSS}</iyy><izz>{ACROSS}</izz></inertia></inertial></link>
        <joint name="j{i}" type="revolute"><pose>{-LENGTH / 2} 0 0 0 0 0</pose><parent>{parent}</parent>
          <child>l{i}</child><axis><xyz>{AXES[i % 2]}</xyz>
          <dynamics><damping>{DAMPING}</damping></dynamics></axis></joint>""")
        with tempfile.NamedTemporaryFile("w", suffix=".sdf") as file:
            file.write(f"""<sdf version="1.9" xmlns:bubblesim="https://bubblesim"><world name="w">
        <physics type="ode"><max_step_size>{STEP}</max_step_size>
          <bubblesim:solver>{solver}</bubblesim:solver></physics>
        <model name="arm">{"".join(parts)}</model></world></sdf>""")
            file.flush()
            self.simulation = bubblesim.Simulation(file.name)
        self.last = self.simulation.object(f"/l{links - 1}")

    def run(self, steps: int) -> None:
        """Run this number of physics substeps."""
        self.simulation.step(steps // SUBSTEPS)

    def position(self) -> Any:
        """Return the position of the last link."""
        return self.last.position


class MuJoCo:
    """The same arm with MuJoCo's defaults, except that damping is implicit, as in bubblesim."""

    def __init__(self, links: int) -> None:
        """Build the model."""
        inside = ""
        for i in reversed(range(links)):
            inside = f"""<body pos="{LENGTH if i else 0} 0 {0 if i else 20}">
            <joint axis="{AXES[i % 2]}" damping="{DAMPING}"/>
            <inertial pos="{LENGTH / 2} 0 0" mass="{MASS}" diaginertia="{ALONG} {ACROSS} {ACROSS}"/>{inside}</body>"""
        self.model = mujoco.MjModel.from_xml_string(
            f"""<mujoco><option timestep="{STEP}" integrator="implicitfast"/><worldbody>{inside}</worldbody></mujoco>"""
        )
        self.data = mujoco.MjData(self.model)

    def run(self, steps: int) -> None:
        """Run this number of physics substeps."""
        mujoco.mj_step(self.model, self.data, steps)

    def position(self) -> Any:
        """Return the position of the last link."""
        mujoco.mj_kinematics(self.model, self.data)  # after a step it is that of the place before
        return self.data.xipos[-1]


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    # 3.5 s: after 5 s of whipping, MuJoCo's arms of 32 links and more are unstable.
    parser.add_argument("--rounds", type=int, default=7)
    rounds = parser.parse_args().rounds
    for links in (8, 16, 32, 64):
        candidates = {"ODE": Ours(links, "ode"), "trees": Ours(links, "bubblesim"), "MuJoCo": MuJoCo(links)}
        for candidate in candidates.values():
            candidate.run(20)  # 0.1 s
        places = [np.array(candidate.position()) for candidate in candidates.values()]
        print(f"{links:3} links  ends are {np.ptp(places, axis=0).max() * 1000:.1f} mm apart after 0.1 s")
        times = medians({name: candidate.run for name, candidate in candidates.items()}, rounds, 100)
        for name, took in times.items():
            print(f"{links:3} links  {name:10} {took:9.2f} us a substep, {took / times['trees']:6.2f} x trees")


if __name__ == "__main__":
    main()
