# SPDX-License-Identifier: BSD-3-Clause
"""The ellipsoid WGS84 and a plane that touches it (Hofmann-Wellenhof et al., GNSS, chapter 8)."""

from __future__ import annotations

import math

import numpy as np

MAJOR, FLATTENING = 6378137.0, 1 / 298.257223563
ECCENTRICITY2 = FLATTENING * (2 - FLATTENING)


def to_earth(latitude: float, longitude: float, altitude: float) -> np.ndarray:
    """Return Earth-centred, Earth-fixed coordinates of degrees and metres above the ellipsoid."""
    phi, lam = math.radians(latitude), math.radians(longitude)
    radius = MAJOR / math.sqrt(1 - ECCENTRICITY2 * math.sin(phi) ** 2)
    return np.array(
        [
            (radius + altitude) * math.cos(phi) * math.cos(lam),
            (radius + altitude) * math.cos(phi) * math.sin(lam),
            (radius * (1 - ECCENTRICITY2) + altitude) * math.sin(phi),
        ]
    )


def plane(origin: tuple[float, float, float]) -> np.ndarray:
    """Return east, north and up at a point of the ellipsoid, as rows."""
    phi, lam = math.radians(origin[0]), math.radians(origin[1])
    s, c, sl, cl = math.sin(phi), math.cos(phi), math.sin(lam), math.cos(lam)
    return np.array([[-sl, cl, 0], [-s * cl, -s * sl, c], [c * cl, c * sl, s]])


def to_local(
    latitude: float, longitude: float, altitude: float, origin: tuple[float, float, float], heading: float = 0.0
) -> np.ndarray:
    """Return metres in the scene, whose x axis is turned by `heading` degrees from east to north."""
    east, north, up = plane(origin) @ (to_earth(latitude, longitude, altitude) - to_earth(*origin))
    c, s = math.cos(math.radians(heading)), math.sin(math.radians(heading))
    return np.array([c * east + s * north, -s * east + c * north, up])
