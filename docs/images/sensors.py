# SPDX-License-Identifier: BSD-3-Clause
"""Renders sensors.png, the picture on the page about cameras: ``python docs/images/sensors.py [FILE]``."""

from __future__ import annotations

import sys
from pathlib import Path

import cv2
import numpy as np

import bubblesim


def main() -> None:
    """Put the camera's picture beside its depth and its labels."""
    simulation = bubblesim.Simulation("sensors")
    simulation.step(20)
    image = simulation.object("/Camera").reading
    near = 255 - np.clip(image.depth / 6 * 255, 0, 255).astype(np.uint8)
    depth = cv2.applyColorMap(near, cv2.COLORMAP_VIRIDIS)
    hues = (np.abs(image.objects) * 67 % 180).astype(np.uint8)
    labels = cv2.cvtColor(np.dstack([hues, np.full_like(hues, 140), np.full_like(hues, 220)]), cv2.COLOR_HSV2BGR)
    labels[image.objects < 0] = 255
    beside = cv2.resize(np.vstack([depth, labels]), (320, 480), interpolation=cv2.INTER_AREA)
    file = sys.argv[1] if len(sys.argv) > 1 else str(Path(__file__).with_suffix(".png"))
    cv2.imwrite(file, np.hstack([image.rgb[:, :, ::-1], beside]))


if __name__ == "__main__":
    main()
