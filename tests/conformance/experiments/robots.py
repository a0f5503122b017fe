# SPDX-License-Identifier: BSD-3-Clause
"""Robots beside a heap that does not touch them. Only bubblesim."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

import numpy as np

import bubblesim

from .experiment import Experiment, Tolerance, product_of
from .metamorphic import heap
from .ours import model_text
from .scene import Scene
from .vehicles import brake_height, cart, driven

COMMANDS = {  # motors of the bundled robots, rad/s
    "tricycle": {"FrontMotor": 2.0},
    "pioneer_p3dx": {"Pioneer_p3dx_leftMotor": 3.0, "Pioneer_p3dx_rightMotor": 4.0},
    "bubblerob": {"rosInterfaceControlledBubbleRobLeftMotor": 5.0, "rosInterfaceControlledBubbleRobRightMotor": 6.0},
}


def nothing(**case: Any) -> float:
    """What does not touch a robot does not act on it."""
    return 0.0


def drive(robot: str, with_heap: bool) -> np.ndarray:
    """Return where a bundled robot is after 3 s."""
    with tempfile.TemporaryDirectory() as folder:
        models = "".join(model_text(model, Path(folder)) for model in heap()) if with_heap else ""
        scene = f"""<sdf version="1.9" xmlns:bubblesim="https://bubblesim"><world name="w">
            <physics name="p" type="ode"><max_step_size>0.005</max_step_size></physics>
            <include><uri>model://floor</uri></include><include><uri>model://{robot}</uri><name>Robot</name></include>
            {models}</world></sdf>"""
        path = Path(folder) / "scene.sdf"
        path.write_text(scene)
        simulation = bubblesim.Simulation(str(path))
    for motor, speed in COMMANDS[robot].items():
        simulation.object(f"/{motor}").target_velocity = speed
    simulation.step(60)
    return np.array(simulation.object("/Robot").position)


def beside_heap(engine: Any, robot: str) -> float:
    """Return the difference of the robot's ways without and with the heap, as a share of the way."""
    if robot == "braking cart":
        return braked(engine)
    alone, beside = drive(robot, False), drive(robot, True)
    return float(np.linalg.norm(beside - alone) / np.linalg.norm(alone[:2]))


def braked(engine: Any) -> float:
    """Return the relative difference of a braking cart's ways in 0.5 s."""
    ways = []
    for others in ((), heap()):
        model = cart(brake_height(0.6), locked="rear")

        def with_others(scene: Scene, others: Any = others) -> Any:
            return engine(Scene((*scene.models, *others), step=scene.step))

        world = driven(with_others, model, 2.0)
        start = world.position("chassis")
        world.run(0.5)
        ways.append(float(np.linalg.norm(world.position("chassis") - start)))
    return abs(ways[1] / ways[0] - 1)


EXPERIMENTS = [
    Experiment(
        "far_heap",
        "Robots with and without a heap 50 m away, relative difference of the way",
        "",
        nothing,
        beside_heap,
        Tolerance("one part in a hundred", absolute=0.01),
        product_of(robot=("tricycle", "pioneer_p3dx", "bubblerob", "braking cart")),
        peers=(),
    ),
]
