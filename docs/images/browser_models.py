# SPDX-License-Identifier: BSD-3-Clause
"""Renders the models of CoppeliaSim's browser: ``python docs/images/browser_models.py [FOLDER]``."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

import cv2
import numpy as np
from robots import Image, photograph

import bubblesim
from bubblesim.scripting.api.sim.browser_models import BROWSER_MODELS

UR_POSE = (0.6, 0.7, -1.2, -0.6, 0.9, 0.0)
# The object, its joints' positions in their order, how far away the camera is, and at which place it looks, in m.
VIEWS: tuple[tuple[str, Sequence[float], float, Sequence[float]], ...] = (
    ("PioneerP3DX", (), 1.1, (0, 0, 0.1)),
    ("ePuck", (), 0.2, (0, 0, 0.022)),
    ("LineTracer", (), 0.36, (0.02, 0, 0.03)),
    ("bubbleRob", (), 0.65, (0, 0, 0.1)),
    ("Quadcopter", (), 0.8, (0, 0, 0.5)),
    ("UR3", UR_POSE, 1.2, (0, 0, 0.3)),
    ("UR5", UR_POSE, 1.8, (0, 0.1, 0.45)),
    ("UR10", UR_POSE, 2.5, (0, 0.2, 0.6)),
    ("Franka", (0.4, 0.3, 0.0, -1.9, 0.0, 2.2, 0.8, 0.03, 0.03), 2.0, (0.25, 0.1, 0.4)),
    ("RG2", (0.04, 0.04), 0.6, (0.1, 0, 0.06)),
    ("youBot", (0, 0, 0, 0, 0.5, 0.6, 0.9, 0.6, 0.0), 1.7, (0.15, 0, 0.2)),
    ("dr12", (), 0.55, (0.01, 0, 0.045)),
    ("dr20", (), 0.75, (0, 0, 0.1)),
    ("Kilobot", (), 0.11, (0, 0, 0.012)),
    ("BarrettHand", (0.6, 0.6, 0.2, 0.6, 0.6, 0.2, 0.6, 0.2), 0.6, (0.1, 0, 0.05)),
    ("conveyor", (), 2.6, (0, 0, 0.1)),
    ("Bill", (0.2, -0.5, 0.3, 0.2, 0.4, -0.4, 0.3, 0.5, 0.0, -0.4, -0.5), 3.9, (0, 0, 0.9)),
)


def view(name: str, positions: Sequence[float], distance: float, place: Sequence[float]) -> Image:
    """One model on the floor of an empty hall."""
    simulation = bubblesim.Simulation("p3dx_floor")
    simulation.remove_model(simulation.object("/PioneerP3DX").handle)
    model = next(each for each in BROWSER_MODELS if each.object == name)
    simulation.add_model(model.text(), name=name)
    world = simulation.world
    parts = [each.handle for each in simulation.objects if each.path.startswith(f"/{name}/")]
    joints = [each for each in parts if world.kind(each) == "joint" and world.joint_type(each) != "fixed"]
    joints += [each for each in parts if world.kind(each) == "frame" and world.frame_kind(each) == "joint"]
    for joint, position in zip(joints, positions, strict=False):
        world.set_joint_position(joint, position)
    eye = np.add(place, (0.75 * distance, -0.66 * distance, 0.45 * distance))
    return photograph(simulation, list(eye), place, 0.62)


def main() -> None:
    """Put the pictures in rows of four."""
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent
    pictures = [cv2.resize(view(*each), (320, 240), interpolation=cv2.INTER_AREA) for each in VIEWS]
    framed = [cv2.copyMakeBorder(each, 3, 3, 3, 3, cv2.BORDER_CONSTANT, value=(255, 255, 255)) for each in pictures]
    framed += [np.full_like(framed[0], 255)] * (-len(framed) % 4)
    rows = [np.hstack(framed[i : i + 4]) for i in range(0, len(framed), 4)]
    cv2.imwrite(str(folder / "browser_models.png"), np.vstack(rows)[:, :, ::-1])


if __name__ == "__main__":
    main()
