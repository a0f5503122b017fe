# SPDX-License-Identifier: BSD-3-Clause
"""Renders the pictures on the robots' pages: ``python docs/images/robots.py [FOLDER]``."""

from __future__ import annotations

import math
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import cv2
import numpy as np

import bubblesim

Image = np.ndarray[Any, np.dtype[np.uint8]]

WIDTH, HEIGHT = 640, 480
CAMERA = f"""<sdf version="1.9" xmlns:bubblesim="https://bubblesim">
  <model name="Photographer"><static>true</static><link name="link">
    <sensor name="Lens" type="camera"><camera>
      <horizontal_fov>{{}}</horizontal_fov>
      <image><width>{WIDTH}</width><height>{HEIGHT}</height></image>
      <clip><near>0.02</near><far>60</far></clip>
      <bubblesim:antialias>true</bubblesim:antialias>
    </camera></sensor>
  </link></model>
</sdf>"""


def photograph(
    simulation: bubblesim.Simulation, eye: Sequence[float], at: Sequence[float], field_of_view: float
) -> Image:
    """What a camera at one place sees when it looks at another, metres and radians."""
    x, y, z = np.subtract(at, eye)
    yaw, pitch = math.atan2(y, x) / 2, -math.atan2(z, math.hypot(x, y)) / 2
    turn = [
        -math.sin(yaw) * math.sin(pitch),
        math.cos(yaw) * math.sin(pitch),
        math.sin(yaw) * math.cos(pitch),
        math.cos(yaw) * math.cos(pitch),
    ]
    camera = simulation.add_model(CAMERA.format(field_of_view), position=eye, orientation=turn)
    picture: Image = simulation.object("/Lens").reading.rgb.copy()
    simulation.remove_model(camera.handle)
    return picture


def enlarged(picture: Image) -> Image:
    """A small camera's picture in the size of the others."""
    return np.asarray(cv2.resize(picture, (WIDTH, HEIGHT), interpolation=cv2.INTER_CUBIC), np.uint8)


def points_from_above(points: np.ndarray[Any, np.dtype[np.float32]], reach: float) -> Image:
    """A lidar's points within some metres of it, x to the right, coloured by their height."""
    picture = np.full((HEIGHT, WIDTH, 3), 22, np.uint8)
    heights = np.clip((points[:, 2] + 0.4) / 1.8 * 255, 0, 255).astype(np.uint8)
    colors = cv2.applyColorMap(heights, cv2.COLORMAP_TURBO)[:, 0, ::-1]
    scale = HEIGHT / 2 / reach
    for (x, y, _), color in zip(points, colors, strict=True):
        place = (round(WIDTH / 2 + x * scale), round(HEIGHT / 2 - y * scale))
        cv2.circle(picture, place, 1, tuple(int(part) for part in color), -1, cv2.LINE_AA)
    cv2.circle(picture, (WIDTH // 2, HEIGHT // 2), 5, (255, 255, 255), -1, cv2.LINE_AA)
    return picture


def pioneer() -> list[Image]:
    """It in its room, the room, what its camera sees, and the points of its lidar."""
    simulation = bubblesim.Simulation("pioneer")
    simulation.step(10)
    near = photograph(simulation, (0.95, -0.75, 0.6), (-0.02, 0.0, 0.14), 0.62)
    room = photograph(simulation, (-3.3, -2.6, 2.3), (0.9, 0.6, 0.1), 1.25)
    points = points_from_above(simulation.object("/Pioneer_p3dx_lidar").reading.points, 3.3)
    return [near, room, enlarged(simulation.object("/Pioneer_p3dx_camera").reading.rgb), points]


def tricycle() -> list[Image]:
    """It, its room, and what its camera sees."""
    simulation = bubblesim.Simulation("tricycle")
    simulation.object("/Steering").target_position = 0.35
    simulation.object("/FrontMotor").target_velocity = 2.0
    simulation.step(50)
    x, y, _ = simulation.object("/Tricycle").position
    near = photograph(simulation, (x + 2.6, y - 2.3, 1.7), (x + 0.5, y + 0.1, 0.4), 0.75)
    room = photograph(simulation, (-4.6, -4.4, 4.2), (0.6, 0.3, 0.0), 1.15)
    return [near, room, enlarged(simulation.object("/Camera").reading.rgb)]


def bubblerob() -> list[Image]:
    """It, its room, and what lies before its nose."""
    simulation = bubblesim.Simulation("bubblerob")
    simulation.step(10)
    x, y, _ = simulation.object("/rosInterfaceControlledBubbleRob").position
    near = photograph(simulation, (x + 0.5, y - 0.42, 0.33), (x, y, 0.1), 0.62)
    room = photograph(simulation, (-1.4, -1.4, 1.3), (0.2, 0.15, 0.0), 1.15)
    view = photograph(simulation, (x + 0.12, y, 0.12), (x + 1.0, y, 0.12), 1.2)
    return [near, room, view]


def quadcopter() -> list[Image]:
    """It on its pad, in flight, and what lies below it."""
    simulation = bubblesim.Simulation("quadcopter")
    simulation.step(10)
    near = photograph(simulation, (0.62, -0.5, 0.42), (0.0, 0.0, 0.06), 0.75)
    simulation.object("/Quadcopter").position = [0.0, 0.0, 1.0]
    flying = photograph(simulation, (2.2, -1.6, 0.8), (0.0, 0.0, 0.7), 0.75)
    below = photograph(simulation, (0.0, 0.0, 0.98), (0.35, 0.0, 0.0), 1.2)
    return [near, flying, below]


def main() -> None:
    """Put the pictures of each robot side by side."""
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent
    for robot in (pioneer, tricycle, bubblerob, quadcopter):
        pictures = [cv2.resize(picture, (426, 320), interpolation=cv2.INTER_AREA) for picture in robot()]
        framed = [cv2.copyMakeBorder(each, 0, 0, 3, 3, cv2.BORDER_CONSTANT, value=(255, 255, 255)) for each in pictures]
        cv2.imwrite(str(folder / f"robot_{robot.__name__}.png"), np.hstack(framed)[:, :, ::-1])


if __name__ == "__main__":
    main()
