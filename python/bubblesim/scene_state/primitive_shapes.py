# SPDX-License-Identifier: BSD-3-Clause
"""The models of shapes that scripts and programs create."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

_DENSITY = 1000.0  # kg/m^3
_FLAT = 1e-4  # m, height of planes and discs
PLANE, DISC, CUBOID, SPHEROID, CYLINDER, CONE, CAPSULE = 1, 2, 3, 4, 5, 6, 8
_NAMES = {
    PLANE: "Plane",
    DISC: "Disc",
    CUBOID: "Cuboid",
    SPHEROID: "Sphere",
    CYLINDER: "Cylinder",
    CONE: "Cone",
    CAPSULE: "Capsule",
}


@dataclass
class PrimitiveShape:
    """A model of one link with one shape."""

    kind: int
    """sim.primitiveshape_cuboid ..."""
    sizes: list[float]
    """Full lengths along x, y, z in m."""
    mass: float = 0.0
    """kg; 0: that of water of this volume."""
    static: bool = True
    respondable: bool = False
    """Other shapes collide with it."""

    def __post_init__(self) -> None:
        """Check kind and sizes."""
        if self.kind not in _NAMES:
            raise ValueError(
                f"{self.kind} is not a supported primitive shape: use sim.primitiveshape_plane, disc, cuboid, "
                "spheroid, cylinder, cone or capsule"
            )
        if len(self.sizes) != 3 or not all(0 < size < 1e4 for size in self._lengths()):
            raise ValueError(f"the sizes of a shape are three lengths in m from 0 to 10000, found {self.sizes}")
        x, y, z = self._lengths()
        if self.kind in (DISC, CYLINDER, CONE, CAPSULE) and not math.isclose(x, y):
            raise ValueError(f"a {self.name.lower()} must have equal sizes along x and y, found {x:g} and {y:g}")
        if self.kind == CAPSULE and z < x:
            raise ValueError(f"a capsule is at least as long as thick, found {z:g} and {x:g}")
        if not self.mass:
            self.mass = _DENSITY * self.volume

    @property
    def name(self) -> str:
        """Its name in the scene, before it is renamed."""
        return _NAMES[self.kind]

    def sdf(self) -> str:
        """Return the model as SDFormat."""
        geometry = f"<geometry>{self.geometry}</geometry>"
        apart = "" if self.respondable else "<surface><contact><collide_bitmask>0</collide_bitmask></contact></surface>"
        collision = f'<collision name="collision">{geometry}{apart}</collision>'
        xx, yy, zz = self.inertia
        return (
            f'<sdf version="1.9"><model name="{self.name}"><link name="link"><gravity>{str(not self.static).lower()}'
            f"</gravity><inertial><mass>{self.mass!r}</mass><inertia><ixx>{xx!r}</ixx><iyy>{yy!r}</iyy><izz>{zz!r}</izz>"
            f'</inertia></inertial>{collision}<visual name="visual">{geometry}</visual></link></model></sdf>'
        )

    def _lengths(self) -> Sequence[float]:
        return [*self.sizes[:2], _FLAT] if self.kind in (PLANE, DISC) else self.sizes

    @property
    def volume(self) -> float:
        """Its volume, m^3."""
        x, y, z = self._lengths()
        if self.kind == SPHEROID:
            return math.pi / 6 * x * y * z
        if self.kind in (DISC, CYLINDER):
            return math.pi / 4 * x * y * z
        if self.kind == CONE:
            return math.pi / 12 * x * y * z
        if self.kind == CAPSULE:
            return math.pi / 4 * x * x * (z - x) + math.pi / 6 * x**3
        return x * y * z

    @property
    def inertia(self) -> tuple[float, float, float]:
        """The moments about the centre in kg m^2; of a capsule those of a cylinder of its length."""
        x, y, z = self._lengths()
        if self.kind == SPHEROID:
            a, b, c = (self.mass / 20 * size * size for size in (x, y, z))
        elif self.kind in (PLANE, CUBOID):
            a, b, c = (self.mass / 12 * size * size for size in (x, y, z))
        elif self.kind == CONE:  # of the length z, about its centre of mass, which is taken for that of the shape
            a = b = self.mass * 3 / 80 * x * x
            c = self.mass * 3 / 80 * z * z
        else:
            a = b = self.mass / 16 * x * x
            c = self.mass / 12 * z * z
        return b + c, a + c, a + b

    @property
    def geometry(self) -> str:
        """What is in its <geometry>."""
        x, y, z = self._lengths()
        if self.kind == SPHEROID and x == y == z:
            return f"<sphere><radius>{x / 2!r}</radius></sphere>"
        if self.kind == SPHEROID:
            return f"<ellipsoid><radii>{x / 2!r} {y / 2!r} {z / 2!r}</radii></ellipsoid>"
        if self.kind in (DISC, CYLINDER):
            return f"<cylinder><radius>{x / 2!r}</radius><length>{z!r}</length></cylinder>"
        if self.kind == CONE:
            return f"<cone><radius>{x / 2!r}</radius><length>{z!r}</length></cone>"
        if self.kind == CAPSULE:
            return f"<capsule><radius>{x / 2!r}</radius><length>{z - x!r}</length></capsule>"
        return f"<box><size>{x!r} {y!r} {z!r}</size></box>"
