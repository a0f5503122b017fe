# SPDX-License-Identifier: BSD-3-Clause
"""Maps drawn as text: # is a wall, a blank is free, ? is unknown. The last line is the map's first row."""

import numpy as np

from bubblesim.navigation.grid_map import GridMap

KINDS = {"#": 100, " ": 0, "?": -1}


def drawn(picture: str, resolution: float = 0.5, origin: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> GridMap:
    lines = [line for line in picture.splitlines() if line]
    width = max(map(len, lines))
    rows = [[KINDS[letter] for letter in line.ljust(width)] for line in reversed(lines)]
    return GridMap(np.array(rows, dtype=np.int8), resolution, origin)
