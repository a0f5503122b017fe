# SPDX-License-Identifier: BSD-3-Clause
"""Reads maps in the format of ROS's map_server: a yaml file and an image."""

import math
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import numpy.typing as npt
import yaml

from bubblesim.navigation.grid_map import GridMap

MODES = ("trinary", "scale", "raw")
REQUIRED = ("image", "resolution", "origin", "occupied_thresh", "free_thresh", "negate")


class MapFileError(ValueError):
    """A map cannot be read; the text states the file and the reason."""


def read_map(file: Path) -> GridMap:
    """Read the map described by a yaml file. Raise MapFileError on failure."""
    try:
        description = yaml.safe_load(file.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise MapFileError(f"{file}: {error}") from error
    if not isinstance(description, dict):
        raise MapFileError(f"{file}: must be a mapping of names to values")
    missing = [name for name in REQUIRED if name not in description]
    if missing:
        raise MapFileError(f"{file}: missing: {', '.join(missing)}")
    mode = description.get("mode", "trinary")
    if mode not in MODES:
        raise MapFileError(f"{file}: mode is {mode!r}, expected one of {', '.join(MODES)}")
    try:
        resolution, occupied, free, x, y, heading = map(
            float,
            (
                description["resolution"],
                description["occupied_thresh"],
                description["free_thresh"],
                *description["origin"],
            ),
        )
        negate = bool(int(description["negate"]))
    except (TypeError, ValueError) as error:
        raise MapFileError(f"{file}: {error}; origin must be [x, y, yaw], the others numbers") from error
    if not (math.isfinite(resolution) and resolution > 0 and all(map(math.isfinite, (x, y, heading)))):
        raise MapFileError(f"{file}: resolution must be greater than 0, and origin finite")
    if mode != "raw" and not 0 <= free < occupied <= 1:
        raise MapFileError(f"{file}: free_thresh must be less than occupied_thresh, both from 0 to 1")
    shades, seen = _picture(file, file.parent / str(description["image"]))
    if negate:
        shades = 255 - shades
    cells = _raw(shades) if mode == "raw" else _cells(shades, seen, occupied, free, trinary=mode == "trinary")
    return GridMap(np.ascontiguousarray(cells[::-1]), resolution, (x, y, heading))


def _picture(file: Path, image: Path) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.bool_]]:
    """Return the grey values from 0 to 255, and a mask of the pixels that are not transparent."""
    pixels: Any = cv2.imread(str(image), cv2.IMREAD_UNCHANGED)
    if pixels is None:
        raise MapFileError(f"{file}: cannot read image {image}")
    if pixels.dtype != np.uint8:
        raise MapFileError(f"{file}: image {image} must have 8 bits per channel")
    channels = pixels.reshape(*pixels.shape[:2], -1)
    has_alpha = channels.shape[2] in (2, 4)
    seen = channels[:, :, -1] > 0 if has_alpha else np.ones(channels.shape[:2], dtype=bool)
    colours = channels[:, :, :-1] if has_alpha else channels
    return colours.mean(axis=2), seen


def _raw(shades: npt.NDArray[np.float64]) -> npt.NDArray[np.int8]:
    """Interpret grey values as per cent; others are unknown."""
    return np.where(shades <= 100, shades, -1).astype(np.int8)


def _cells(
    shades: npt.NDArray[np.float64],
    seen: npt.NDArray[np.bool_],
    occupied: float,
    free: float,
    *,
    trinary: bool,
) -> npt.NDArray[np.int8]:
    occupancy = (255.0 - shades) / 255.0
    between = np.full(shades.shape, -1, dtype=np.int8)
    if not trinary:
        ratio = (occupancy - free) / (occupied - free)
        between = np.where(seen, 1 + 98 * np.clip(ratio, 0, 1), -1).astype(np.int8)
    cells = np.where(occupancy > occupied, 100, np.where(occupancy < free, 0, between))
    return cells.astype(np.int8)
