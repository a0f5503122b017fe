# SPDX-License-Identifier: BSD-3-Clause
"""Renders the scene of the examples of CoppeliaSim's client: ``python docs/images/messaging_scenes.py [FOLDER]``."""

from __future__ import annotations

import sys
from pathlib import Path

import cv2
from robots import photograph

import bubblesim

SCENE = Path(bubblesim.scene_folders()[-1]) / "messaging" / "movementViaRemoteApi.sdf"
# Positions of the joints, in their order.
POSES: dict[str, tuple[float, ...]] = {
    "blueArm": (0.6, 0.7, -1.2, -0.6, 0.9, 0.0),
    "redArm": (0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    "blueRobot": (0.8, 0.6, 0.3, -1.2, 0.0, 0.9, 0.0),
    "redRobot": (0.2, 1.0, 0.0, -0.9, 0.4, 0.7, 0.0),
    "greenRobot": (0.0, 0.9, 0.0, -1.8, 0.0, 0.9, 0.0),
}


def main() -> None:
    """Put the arms in poses, and look at all of them."""
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent
    simulation = bubblesim.Simulation(str(SCENE))
    for arm, positions in POSES.items():
        joints = [each for each in simulation.objects if each.path.startswith(f"/{arm}/joint") and each.kind == "joint"]
        for joint, position in zip(joints, positions, strict=False):
            simulation.world.set_joint_position(joint.handle, position)
    picture = photograph(simulation, [4.6, -2.9, 2.1], (1.1, 0.1, 0.35), 0.75)
    cv2.imwrite(str(folder / "messaging_scenes.png"), picture[:, :, ::-1])


if __name__ == "__main__":
    main()
