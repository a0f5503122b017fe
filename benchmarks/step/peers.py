# SPDX-License-Identifier: BSD-3-Clause
"""Compare physics substeps of one tricycle, one among 200 boxes, and many tricycles with MuJoCo and PyBullet.

Both solvers of bubblesim are candidates: ODE, and trees in generalised coordinates.

    python benchmarks/step/peers.py [--rounds N]

Needs the workspace and `pip install -r benchmarks/requirements.txt`. The candidates run alternately in every round, so
that other load affects them equally; the table shows medians over the rounds. All loops run in C or C++. The program
first prints how far each tricycle drives in the same time.
"""

from __future__ import annotations

import argparse
import math
import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pybullet

import bubblesim

STEP = 0.005  # s, for all candidates
SUBSTEPS = 10  # physics substeps in a step of bubblesim
STEPS = 400  # physics substeps of a candidate per round
STEERING, SPEED = 0.6, 1.0  # rad, rad/s
GROUND, OBSTACLE = 1, 2  # collide bits


def boxes(count: int) -> list[tuple[float, float, float]]:
    """Return position and heading of static boxes of 0.4 m, around the circle that the tricycle drives."""
    rng = np.random.default_rng(3)
    found: list[tuple[float, float, float]] = []
    while len(found) < count:
        x, y = rng.uniform(-15, 15, 2)
        if math.hypot(x, y) > 6:
            found.append((x, y, rng.uniform(-3, 3)))
    return found


def scene_of(box_count: int, robots: int = 1, more: str = "", solver: str = "bubblesim") -> str:
    """Return a scene of boxes and tricycles side by side, in SDFormat."""
    models = "".join(
        f"""<model name="Box{i}"><static>true</static><pose>{x} {y} 0.2 0 0 {heading}</pose><link name="l">
        <collision name="c"><geometry><box><size>0.4 0.4 0.4</size></box></geometry></collision></link></model>"""
        for i, (x, y, heading) in enumerate(boxes(box_count))
    )
    models += "".join(
        f"""<include><uri>model://tricycle</uri><name>Tricycle{i}</name>
        <pose>{8 * (i % 10)} {8 * (i // 10)} 0 0 0 0</pose></include>"""
        for i in range(robots)
    )
    return f"""<sdf version="1.9" xmlns:bubblesim="https://bubblesim"><world name="w">
        <physics name="p" type="ode"><max_step_size>{STEP}</max_step_size>
        <bubblesim:solver>{solver}</bubblesim:solver></physics>
        <include><uri>model://floor</uri></include>{models}{more}</world></sdf>"""


class Ours:
    """Tricycles side by side in bubblesim."""

    def __init__(self, box_count: int, robots: int = 1, more: str = "", solver: str = "bubblesim") -> None:
        """Load the scene, with more models in SDFormat, and set the commands for a circle."""
        with tempfile.NamedTemporaryFile("w", suffix=".sdf") as file:
            file.write(scene_of(box_count, robots, more, solver))
            file.flush()
            self.simulation = bubblesim.Simulation(file.name)
        for i in range(robots):
            self.simulation.object(f"/Tricycle{i}/Steering").target_position = STEERING
            self.simulation.object(f"/Tricycle{i}/FrontMotor").target_velocity = SPEED

    def run(self, steps: int) -> None:
        """Run this number of physics substeps."""
        self.simulation.step(steps // SUBSTEPS)

    def position(self) -> Any:
        """Return the position of the (first) tricycle."""
        return self.simulation.object("/Tricycle0").position


class MuJoCo:
    """The same tricycle with MuJoCo's defaults, except the integrator: Euler is unstable with these motors."""

    def __init__(self, box_count: int) -> None:
        """Build the model."""
        obstacles = "".join(
            f'<geom type="box" size=".2 .2 .2" pos="{x} {y} .2" euler="0 0 {math.degrees(heading)}"'
            f' contype="{OBSTACLE}" conaffinity="{OBSTACLE}"/>'
            for x, y, heading in boxes(box_count)
        )

        def wheel(name: str, x: float, y: float, inside: str = "") -> str:
            return f"""<body name="{name}_wheel" pos="{x} {y} 0"><joint name="{name}" axis="0 1 0"/>
                <inertial pos="0 0 0" mass="2" diaginertia=".05 .09 .05"/>
                <geom type="sphere" size=".3" contype="{GROUND}" conaffinity="{GROUND}"/>
                <geom type="cylinder" size=".29 .03" euler="90 0 0" contype="{OBSTACLE}" conaffinity="{OBSTACLE}"/>
                {inside}</body>"""

        self.model = mujoco.MjModel.from_xml_string(f"""<mujoco>
            <option timestep="{STEP}" integrator="implicitfast"/><worldbody>
            <geom type="plane" size="50 50 1" contype="{GROUND}" conaffinity="{GROUND}"/>{obstacles}
            <body name="frame" pos="0 0 .3"><freejoint/>
              <inertial pos=".4 0 .1" mass="20" diaginertia=".6 2.6 3"/>
              <geom type="box" size=".65 .2 .15" pos=".5 0 .15" contype="{OBSTACLE}" conaffinity="{OBSTACLE}"/>
              <body pos="1 0 0"><joint name="steering" axis="0 0 1" range="-85 85" limited="true"/>
                <inertial pos="0 0 0" mass="2" diaginertia=".02 .02 .02"/>{wheel("motor", 0, 0)}</body>
              {wheel("left", 0, 0.4)}{wheel("right", 0, -0.4)}
            </body></worldbody>
            <contact><exclude body1="frame" body2="motor_wheel"/></contact>
            <actuator><position joint="steering" kp="200" kv="20" forcerange="-100 100"/>
              <velocity joint="motor" kv="50" forcerange="-50 50"/></actuator></mujoco>""")
        self.data = mujoco.MjData(self.model)
        self.data.ctrl[:] = STEERING, SPEED

    def run(self, steps: int) -> None:
        """Run this number of physics substeps."""
        mujoco.mj_step(self.model, self.data, steps)

    def position(self) -> Any:
        """Return the position of the (first) tricycle."""
        return self.data.qpos[:3]


class PyBullet:
    """The same tricycle without the cylinders of its wheels: a link has one filter for all its shapes."""

    def __init__(self, box_count: int) -> None:
        """Build the model."""
        self.client = pybullet.connect(pybullet.DIRECT)
        of = {"physicsClientId": self.client}
        pybullet.setPhysicsEngineParameter(fixedTimeStep=STEP, numSolverIterations=50, **of)
        pybullet.setGravity(0, 0, -9.81, **of)
        plane = pybullet.createMultiBody(0, pybullet.createCollisionShape(pybullet.GEOM_PLANE, **of), **of)
        pybullet.setCollisionFilterGroupMask(plane, -1, GROUND, GROUND, **of)
        cube = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=[0.2] * 3, **of)
        for x, y, heading in boxes(box_count):
            turn = pybullet.getQuaternionFromEuler([0, 0, heading])
            box = pybullet.createMultiBody(0, cube, basePosition=[x, y, 0.2], baseOrientation=turn, **of)
            pybullet.setCollisionFilterGroupMask(box, -1, OBSTACLE, OBSTACLE, **of)
        wheel = pybullet.createCollisionShape(pybullet.GEOM_SPHERE, radius=0.3, **of)
        frame = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=[0.65, 0.2, 0.15], **of)
        self.robot = pybullet.createMultiBody(
            20,
            frame,
            basePosition=[0.4, 0, 0.4],
            linkMasses=[2, 2, 2, 2],
            linkCollisionShapeIndices=[-1, wheel, wheel, wheel],
            linkVisualShapeIndices=[-1] * 4,
            linkPositions=[[0.6, 0, -0.1], [0, 0, 0], [-0.4, 0.4, -0.1], [-0.4, -0.4, -0.1]],
            linkOrientations=[[0, 0, 0, 1]] * 4,
            linkInertialFramePositions=[[0, 0, 0]] * 4,
            linkInertialFrameOrientations=[[0, 0, 0, 1]] * 4,
            linkParentIndices=[0, 1, 0, 0],
            linkJointTypes=[pybullet.JOINT_REVOLUTE] * 4,
            linkJointAxis=[[0, 0, 1], [0, 1, 0], [0, 1, 0], [0, 1, 0]],
            **of,
        )
        pybullet.setCollisionFilterGroupMask(self.robot, -1, OBSTACLE, OBSTACLE, **of)
        for link in (1, 2, 3):
            pybullet.setCollisionFilterGroupMask(self.robot, link, GROUND, GROUND, **of)
            pybullet.changeDynamics(self.robot, link, lateralFriction=1, **of)
        for joint in (2, 3):
            pybullet.setJointMotorControl2(self.robot, joint, pybullet.VELOCITY_CONTROL, force=0, **of)
        pybullet.setJointMotorControl2(
            self.robot, 0, pybullet.POSITION_CONTROL, targetPosition=STEERING, force=100, **of
        )
        pybullet.setJointMotorControl2(self.robot, 1, pybullet.VELOCITY_CONTROL, targetVelocity=SPEED, force=50, **of)

    def run(self, steps: int) -> None:
        """Run this number of physics substeps."""
        for _ in range(steps):
            pybullet.stepSimulation(physicsClientId=self.client)

    def position(self) -> Any:
        """Return the position of the (first) tricycle."""
        return pybullet.getBasePositionAndOrientation(self.robot, physicsClientId=self.client)[0]


def microseconds(run: Callable[[int], None], steps: int) -> float:
    """Return the microseconds per physics substep of one round."""
    start = time.perf_counter()
    run(steps)
    return (time.perf_counter() - start) / steps * 1e6


def medians(runs: dict[str, Callable[[int], None]], rounds: int, steps: int = STEPS) -> dict[str, float]:
    """Return the median microseconds per physics substep of each candidate; the candidates run alternately."""
    found: dict[str, list[float]] = {name: [] for name in runs}
    for _ in range(rounds):
        for name, run in runs.items():
            found[name].append(microseconds(run, steps))
    return {name: statistics.median(times) for name, times in found.items()}


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=41)
    rounds = parser.parse_args().rounds
    print(f"bubblesim {Path(bubblesim.__file__).parent}, MuJoCo {mujoco.__version__}, PyBullet 3.2.7")
    for count in (0, 200):
        candidates = {
            "ODE": Ours(count, solver="ode"),
            "trees": Ours(count),
            "MuJoCo": MuJoCo(count),
            "PyBullet": PyBullet(count),
        }
        for name, candidate in candidates.items():
            before = np.array(candidate.position())
            candidate.run(200)
            print(f"  {name} moved {np.linalg.norm(np.array(candidate.position()) - before):.2f} m in a second")
        times = medians({name: candidate.run for name, candidate in candidates.items()}, rounds)
        for name, took in times.items():
            print(f"{count:4} boxes  {name:10} {took:8.2f} us a substep, {took / times['ODE']:6.2f} x ODE")
    for solver in ("ode", "bubblesim"):
        crowds = {str(robots): Ours(0, robots, solver=solver).run for robots in (1, 10, 100)}
        for robots, took in medians(crowds, max(rounds // 4, 3), 100).items():
            print(f"{robots:>4} tricycles, {solver:9} {took:10.2f} us a substep, {took / int(robots):6.2f} each")


if __name__ == "__main__":
    main()
