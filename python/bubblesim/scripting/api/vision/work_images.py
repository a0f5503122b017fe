# SPDX-License-Identifier: BSD-3-Clause
"""Operations on images: arrays of rows x columns x 3 of numbers from 0 to 1, rows from bottom to top."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]


def blurred_by(image: Array, kernel: Array) -> Array:
    """Return an image filtered with a square kernel; the border is continued."""
    reach = kernel.shape[0] // 2
    rows, columns = image.shape[:2]
    padded = np.pad(image, ((reach, reach), (reach, reach), (0, 0)), mode="edge")
    result = np.zeros_like(image)
    for i in range(kernel.shape[0]):
        for j in range(kernel.shape[1]):
            result += kernel[i, j] * padded[i : i + rows, j : j + columns]
    return result


def edges(image: Array, threshold: float) -> Array:
    """Return white where the intensity changes by more than a threshold between pixels beside each other."""
    grey = image.mean(axis=2)
    found = np.zeros(grey.shape, bool)
    across, along = np.abs(np.diff(grey, axis=1)) > threshold, np.abs(np.diff(grey, axis=0)) > threshold
    found[:, :-1] |= across
    found[:-1] |= along
    return np.repeat(found.astype(float)[:, :, None], 3, axis=2)


def rotated(image: Array, angle: float) -> Array:
    """Return an image that is rotated about its centre by an angle, rad, counter-clockwise; black beyond."""
    rows, columns = image.shape[:2]
    y, x = np.mgrid[:rows, :columns].astype(float)
    x, y = x - (columns - 1) / 2, y - (rows - 1) / 2
    from_x = np.rint(math.cos(angle) * x + math.sin(angle) * y + (columns - 1) / 2).astype(int)
    from_y = np.rint(-math.sin(angle) * x + math.cos(angle) * y + (rows - 1) / 2).astype(int)
    inside = (from_x >= 0) & (from_x < columns) & (from_y >= 0) & (from_y < rows)
    result = np.zeros_like(image)
    result[inside] = image[from_y[inside], from_x[inside]]
    return result


def hsl(image: Array) -> Array:
    """Return hue, saturation and lightness, each from 0 to 1, of colours."""
    most, least = image.max(axis=2), image.min(axis=2)
    spread = most - least
    light = (most + least) / 2
    safe = np.where(spread > 0, spread, 1.0)
    red, green, blue = image[:, :, 0], image[:, :, 1], image[:, :, 2]
    hue = np.select(
        [spread == 0, most == red, most == green],
        [0.0, ((green - blue) / safe) % 6, (blue - red) / safe + 2],
        (red - green) / safe + 4,
    )
    bound = 1 - np.abs(2 * light - 1)
    saturation = np.where(bound > 0, spread / np.where(bound > 0, bound, 1.0), 0.0)
    return np.dstack([hue / 6, saturation, light])


def labelled(mask: Array) -> tuple[Array, int]:
    """Return the number of the connected part of each pixel of a mask, 0 outside, and the number of parts."""
    labels = np.zeros(mask.shape, int)
    count = 0
    rows, columns = mask.shape
    for start in zip(*np.nonzero(mask), strict=True):
        if labels[start]:
            continue
        count += 1
        labels[start] = count
        rest = [start]
        while rest:
            i, j = rest.pop()
            for k, m in ((i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)):
                if 0 <= k < rows and 0 <= m < columns and mask[k, m] and not labels[k, m]:
                    labels[k, m] = count
                    rest.append((k, m))
    return labels, count


def blob(places: Array, columns: int, rows: int) -> list[float]:
    """Return size, orientation (rad), x and y of the centre, width and height of the box of some pixels, given as rows
    and columns: shares of the image, the box along the main axis."""
    y, x = (places[:, 0] + 0.5) / rows, (places[:, 1] + 0.5) / columns
    centre_x, centre_y = float(x.mean()), float(y.mean())
    across = np.column_stack([places[:, 1] - places[:, 1].mean(), places[:, 0] - places[:, 0].mean()])
    moments = across.T @ across
    angle = 0.5 * math.atan2(2 * moments[0, 1], moments[0, 0] - moments[1, 1])
    main = across @ np.array([math.cos(angle), math.sin(angle)])
    other = across @ np.array([-math.sin(angle), math.cos(angle)])
    size = len(places) / (columns * rows)
    return [
        size,
        angle,
        centre_x,
        centre_y,
        float(np.ptp(main) + 1) / columns,
        float(np.ptp(other) + 1) / rows,
    ]
