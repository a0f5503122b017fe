# SPDX-License-Identifier: BSD-3-Clause
"""What the shapes that scripts and programs create have in common: a model of one link."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
_MOMENTS = (("ixx", 0, 0), ("iyy", 1, 1), ("izz", 2, 2), ("ixy", 0, 1), ("ixz", 0, 2), ("iyz", 1, 2))


class CreatedShape(Protocol):
    """A model of one link that scripts and programs create."""

    mass: float
    """kg."""
    static: bool
    respondable: bool
    """Other shapes collide with it."""

    @property
    def kind(self) -> int:
        """Return sim.primitiveshape_cuboid ..., primitiveshape_none for others."""

    @property
    def sizes(self) -> list[float]:
        """Return full lengths along x, y, z in m."""

    @property
    def name(self) -> str:
        """Return its name in the scene, before it is renamed."""

    def sdf(self) -> str:
        """Return the model as SDFormat."""


@dataclass
class Part:
    """A shape of a link."""

    geometry: str
    """The element in <geometry>."""
    mass: float
    """kg."""
    inertia: Array
    """3 x 3, kg m^2, about the centre of mass, in the axes of the link."""
    centre: Array
    """Centre of mass in the frame of the link, m."""
    pose: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0])
    """In the frame of the link: x, y, z, qx, qy, qz, qw."""
    colour: list[float] | None = None


def model_sdf(shape: CreatedShape, parts: list[Part]) -> str:
    """Return a model of one link with some parts as SDFormat."""
    apart = "" if shape.respondable else "<surface><contact><collide_bitmask>0</collide_bitmask></contact></surface>"
    mass = sum(part.mass for part in parts)
    centre = sum((part.mass * part.centre for part in parts), np.zeros(3)) / mass
    inertia = np.zeros((3, 3))
    for part in parts:
        arm = part.centre - centre
        inertia += part.inertia + part.mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    elements = []
    for number, part in enumerate(parts):
        pose = f'<pose rotation_format="quat_xyzw">{_words(part.pose)}</pose>'
        material = f"<material><diffuse>{_words(part.colour)} 1</diffuse></material>" if part.colour else ""
        placed = f"{pose}<geometry>{part.geometry}</geometry>"
        last = f"_{number}" if number else ""
        elements.append(
            f'<collision name="collision{last}">{placed}{apart}</collision>'
            f'<visual name="visual{last}">{placed}{material}</visual>'
        )
    # Meshes that may move are warned of: what is static is so for the physics, too.
    still = "<static>true</static>" if shape.static and any("<mesh>" in part.geometry for part in parts) else ""
    moments = "".join(f"<{name}>{float(inertia[i, j])!r}</{name}>" for name, i, j in _MOMENTS)
    return (
        f'<sdf version="1.9"><model name="{shape.name}">{still}<link name="link">'
        f"<gravity>{str(not shape.static).lower()}</gravity>"
        f"<inertial><pose>{_words(centre)} 0 0 0</pose><mass>{float(mass)!r}</mass><inertia>{moments}"
        f"</inertia></inertial>{''.join(elements)}</link></model></sdf>"
    )


def _words(numbers: list[float] | Array) -> str:
    return " ".join(repr(float(number)) for number in numbers)
