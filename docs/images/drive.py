# SPDX-License-Identifier: BSD-3-Clause
"""Renders the moving picture of the README: ``python docs/images/drive.py [FILE]``. Needs Debian's python3-pil."""

from __future__ import annotations

import math
import sys
from pathlib import Path

import numpy as np
from PIL import Image
from robots import photograph

import bubblesim
from bubblesim.controllers.tricycle_avoid import TricycleAvoid

SECONDS, PERIOD = 44.0, 0.55  # of simulated time: of the drive, and between two pictures
SHOWN = 80  # ms for a picture
EYE, AT, FIELD_OF_VIEW = (-4.7, -4.5, 4.3), (0.5, 0.4, 0.0), 1.1  # m, m, rad


def pictures() -> list[Image.Image]:
    """The tricycle and the controller of its tutorial from a corner of the room, with what its camera sees."""
    simulation = bubblesim.Simulation("tricycle")
    controller = TricycleAvoid()
    taken: list[Image.Image] = []
    while simulation.time < SECONDS:
        simulation.step()
        sonar = simulation.object("/FrontSonar").reading
        command = controller.update(sonar.distance if sonar.detected else math.inf, simulation.time_step)
        if command is not None:
            simulation.object("/Steering").target_position = command.steering
            simulation.object("/FrontMotor").target_velocity = command.speed
        if simulation.time >= len(taken) * PERIOD:
            room = Image.fromarray(np.ascontiguousarray(photograph(simulation, EYE, AT, FIELD_OF_VIEW)[36:396]))
            own = Image.fromarray(simulation.object("/Camera").reading.rgb).resize((160, 120), Image.Resampling.LANCZOS)
            framed = Image.new("RGB", (164, 124), "white")
            framed.paste(own, (2, 2))
            room.paste(framed, (8, room.height - framed.height - 8))
            taken.append(room)
    return taken


def main() -> None:
    """Write the animation."""
    file = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent / "drive.webp"
    first, *others = pictures()
    first.save(file, save_all=True, append_images=others, duration=SHOWN, loop=0, quality=55, method=6)


if __name__ == "__main__":
    main()
