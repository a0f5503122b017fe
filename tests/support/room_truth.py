# SPDX-License-Identifier: BSD-3-Clause
"""The expected map of a scene: the outlines of its objects at the height of a robot, from its files."""

import math
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
import numpy.typing as npt

from bubblesim.navigation.grid_map import GridMap

CELL = 0.01  # m, of the expected map
MARGIN = 0.5  # m around the outermost objects


@dataclass(frozen=True)
class Place:
    """Planar pose in the world: m, m, rad."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    heading: float = 0.0

    def then(self, text: str | None) -> "Place":
        """Apply a pose in SDFormat's form. Ignores its roll and pitch."""
        x, y, z, _, _, heading = map(float, (text or "0 0 0 0 0 0").split())
        cosine, sine = math.cos(self.heading), math.sin(self.heading)
        return Place(self.x + cosine * x - sine * y, self.y + sine * x + cosine * y, self.z + z, self.heading + heading)


def outlines(scene: Path, low: float, high: float, *, leave_out: str) -> list[npt.NDArray[np.float64]]:
    """Return the corners of all shapes between two heights, as seen by lidars, except those of one model."""
    world = ElementTree.parse(scene).getroot().find("world")
    assert world is not None
    found: list[npt.NDArray[np.float64]] = []
    for include in world.iter("include"):
        name = (include.findtext("uri") or "").removeprefix("model://")
        if name == leave_out:
            continue
        model = ElementTree.parse(scene.parent / "models" / name / "model.sdf").getroot().find("model")
        if model is None:  # a light
            continue
        place = Place().then(include.findtext("pose") or model.findtext("pose"))
        found += _outlines_of_model(model, place, low, high)
    return found


def _outlines_of_model(
    model: ElementTree.Element, place: Place, low: float, high: float
) -> Iterator[npt.NDArray[np.float64]]:
    for link in model.iter("link"):
        at_link = place.then(link.findtext("pose"))
        for visual in link.iter("visual"):
            at = at_link.then(visual.findtext("pose"))
            shape = _shape(visual.find("geometry"))
            if shape is not None and at.z - shape[1] / 2 < high and at.z + shape[1] / 2 > low:
                cosine, sine = math.cos(at.heading), math.sin(at.heading)
                turn = np.array([[cosine, sine], [-sine, cosine]])
                yield shape[0] @ turn + (at.x, at.y)


def _shape(geometry: ElementTree.Element | None) -> tuple[npt.NDArray[np.float64], float] | None:
    """Return corners from above, and height; None for shapes without corners (the floor)."""
    assert geometry is not None
    box, cylinder, sphere = (geometry.find(kind) for kind in ("box", "cylinder", "sphere"))
    if box is not None:
        x, y, z = (float(number) / 2 for number in (box.findtext("size") or "").split())
        return np.array([[-x, -y], [x, -y], [x, y], [-x, y]]), 2 * z
    round_thing = cylinder if cylinder is not None else sphere
    if round_thing is None:
        return None
    radius = float(round_thing.findtext("radius") or 0)
    angles = np.linspace(0, math.tau, 48, endpoint=False)
    height = float(round_thing.findtext("length") or 2 * radius)
    return radius * np.column_stack([np.cos(angles), np.sin(angles)]), height


def truth_of(shapes: list[npt.NDArray[np.float64]]) -> GridMap:
    """Return the map with occupied cells of one centimetre where shapes are."""
    corners = np.concatenate(shapes)
    low, high = corners.min(axis=0) - MARGIN, corners.max(axis=0) + MARGIN
    columns, rows = np.ceil((high - low) / CELL).astype(int)
    cells = np.zeros((rows, columns), dtype=np.uint8)
    for shape in shapes:
        cv2.fillConvexPoly(cells, np.round((shape - low) / CELL - 0.5).astype(np.int32), 100)
    return GridMap(cells.astype(np.int8), CELL, (float(low[0]), float(low[1]), 0.0))


@dataclass(frozen=True)
class Comparison:
    """Quality of a map."""

    wall_error: float  # m, mean distance of the map's walls to the nearest true surface
    coverage: float  # share of the reachable floor that is free in the map


def compare(grid: GridMap, truth: GridMap, start: tuple[float, float], radius: float) -> Comparison:
    """Compare a map with the expected one, for a round robot that started at `start`."""
    occupied = truth.occupied.astype(np.uint8)
    surface = occupied - cv2.erode(occupied, np.ones((3, 3), np.uint8))
    to_surface = cv2.distanceTransform(1 - surface, cv2.DIST_L2, 5) * CELL
    walls = [grid.centre_of((int(row), int(column))) for row, column in np.argwhere(grid.occupied)]
    errors = [to_surface[truth.cell_of(wall)] if truth.has(truth.cell_of(wall)) else MARGIN for wall in walls]

    reach = (truth.clearance() > radius).astype(np.uint8)
    _, labels = cv2.connectedComponents(reach, connectivity=4)
    middle = (labels == labels[truth.cell_of(start)]).astype(np.uint8)
    floor = np.argwhere(middle)[::7]  # every seventh square centimetre is enough
    seen = 0
    for row, column in floor:
        cell = grid.cell_of(truth.centre_of((int(row), int(column))))
        seen += bool(grid.has(cell) and grid.free[cell])
    return Comparison(float(np.mean(errors)), seen / len(floor))


def picture(grid: GridMap, truth: GridMap) -> npt.NDArray[np.uint8]:
    """Draw the expected map in grey on the left, the map on the right: walls black, free white, unknown beige."""
    rows, columns = truth.cells.shape
    left = np.where(truth.occupied[..., None], (90, 90, 90), (255, 255, 255)).astype(np.uint8)
    right = np.full((rows, columns, 3), (170, 205, 225), np.uint8)
    for row in range(rows):
        for column in range(columns):
            cell = grid.cell_of(truth.centre_of((row, column)))
            if grid.has(cell) and grid.cells[cell] >= 0:
                right[row, column] = 255 * (100 - int(grid.cells[cell])) // 100
    return np.hstack([left, right])[::-1]
