# SPDX-License-Identifier: BSD-3-Clause
"""The demonstration without ROS: the tricycle and the controller of its tutorial in this process."""

from __future__ import annotations

import math
import time
from pathlib import Path

import bubblesim
from bubblesim.controllers.tricycle_avoid import TricycleAvoid
from bubblesim.geometry.rotations import heading_of
from bubblesim.running.recording import Pose, Recording, Sample
from bubblesim.running.stop import Stop

SCENE = "tricycle"
_LINE = 10.0  # s of simulated time between lines


def run(seconds: float, picture: Path) -> None:
    """Run the tricycle for a simulated time or until a signal, at full speed; draw its path if matplotlib is there."""
    stop = Stop()
    recording = Recording()
    controller = TricycleAvoid()
    simulation = bubblesim.Simulation(SCENE)
    robot, sonar = simulation.object("/Tricycle"), simulation.object("/FrontSonar")
    steering, motor = simulation.object("/Steering"), simulation.object("/FrontMotor")
    next_line = _LINE
    while simulation.time < seconds and not stop.requested:
        simulation.step()
        reading = sonar.reading
        recording.add_sonar(reading.distance if reading.detected else math.inf)
        if command := controller.update(recording.sonar, simulation.time_step):
            steering.target_position, motor.target_velocity = command.steering, command.speed
        x, y, z = robot.position
        pose = Pose(x, y, z, heading_of(*robot.orientation))
        recording.samples.append(Sample(time.monotonic(), simulation.time, pose))
        if simulation.time >= next_line:
            next_line += _LINE
            print(recording.live_line(), flush=True)
    print(recording.summary())
    if len(recording.samples) > 1:
        print(f"picture            {_draw(recording, picture)}")


def _draw(recording: Recording, picture: Path) -> str:
    """Write the picture; return its path, or why there is none."""
    try:
        from bubblesim.running.picture import draw
    except ModuleNotFoundError as error:
        return f"none: {error.name} is not installed"
    draw(SCENE, recording, picture)
    return str(picture)
