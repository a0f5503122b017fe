# SPDX-License-Identifier: BSD-3-Clause
"""Hue, lightness and saturation of colours: hue in units of two degrees, the others from 0 to 255."""

from __future__ import annotations

from typing import Any

import numpy as np

_FULL = 255.0
_HUES = 180.0


def hls_of_rgb(colours: Any) -> Any:
    """Return the HLS of an array of RGB from 0 to 255, shape (rows, columns, 3).

    Lightness is the mean of the largest and the smallest part, saturation their difference by the largest that this
    lightness allows.
    """
    rgb = colours[:, :, :3].astype(np.float64) / _FULL
    red, green, blue = np.moveaxis(rgb, 2, 0)
    high, low = rgb.max(axis=2), rgb.min(axis=2)
    span, lightness = high - low, (high + low) / 2
    room = 1 - np.abs(2 * lightness - 1)
    saturation = np.divide(span, room, out=np.zeros_like(span), where=room > 0)
    safe = np.where(span > 0, span, 1)
    sixths = np.select(
        [high == red, high == green], [(green - blue) / safe % 6, (blue - red) / safe + 2], (red - green) / safe + 4
    )
    hue = np.where(span > 0, sixths * _HUES / 6, 0) % _HUES
    return np.rint(np.stack([hue, lightness * _FULL, saturation * _FULL], axis=2)).astype(np.uint8)


def rgb_of_hls(colours: Any) -> Any:
    """Return the RGB, from 0 to 255, of an array of HLS."""
    hue, lightness, saturation = np.moveaxis(colours[:, :, :3].astype(np.float64), 2, 0)
    lightness, saturation = lightness / _FULL, saturation / _FULL
    reach = saturation * np.minimum(lightness, 1 - lightness)
    parts = []
    for begin in (0, 8, 4):  # of red, green and blue, in twelfths of a turn
        place = (begin + hue * 12 / _HUES) % 12
        parts.append(lightness - reach * np.clip(np.minimum(place - 3, 9 - place), -1, 1))
    return np.rint(np.stack(parts, axis=2) * _FULL).astype(np.uint8)
