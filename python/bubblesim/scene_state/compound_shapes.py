# SPDX-License-Identifier: BSD-3-Clause
"""The models of several shapes as one body, which scripts and programs group."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from bubblesim.geometry import poses, rotations
from bubblesim.scene_state.created_shapes import CreatedShape, Part, model_sdf
from bubblesim.scene_state.mesh_shapes import MeshShape
from bubblesim.scene_state.primitive_shapes import PrimitiveShape

_NONE = 0  # sim.primitiveshape_none


@dataclass
class Member:
    """A shape in a compound."""

    shape: PrimitiveShape | MeshShape
    pose: list[float]
    """In the frame of the compound: x, y, z, qx, qy, qz, qw."""
    colour: list[float]


@dataclass
class CompoundShape:
    """A model of one link with several shapes."""

    members: list[Member]
    static: bool = True
    respondable: bool = False
    name: str = "Compound"
    mass: float = 0.0
    """kg; 0: that of the members together."""
    sizes: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])

    def __post_init__(self) -> None:
        """Add up the masses."""
        self.mass = self.mass or sum(member.shape.mass for member in self.members)

    @property
    def kind(self) -> int:
        """Return sim.primitiveshape_none."""
        return _NONE

    def sdf(self) -> str:
        """Return the model as SDFormat."""
        return model_sdf(self, [self._placed(member) for member in self.members])

    def _placed(self, member: Member) -> Part:
        part = _part_of(member.shape)
        share = self.mass / sum(each.shape.mass for each in self.members)
        turn = np.array(rotations.matrix(member.pose[3:]))
        centre = turn @ part.centre + np.array(member.pose[:3])
        return Part(
            part.geometry,
            part.mass * share,
            turn @ part.inertia @ turn.T * share,
            centre,
            pose=member.pose,
            colour=member.colour,
        )


def members_of(shape: CreatedShape, pose: Sequence[float], colour: Sequence[float]) -> list[Member]:
    """Return a shape at a pose as members of a compound: of a compound its own ones."""
    if isinstance(shape, CompoundShape):
        return [Member(each.shape, poses.multiply(pose, each.pose), each.colour) for each in shape.members]
    if not isinstance(shape, PrimitiveShape | MeshShape):
        raise TypeError(f"a {shape.name.lower()} cannot be grouped")
    return [Member(shape, list(pose), list(colour))]


def _part_of(shape: PrimitiveShape | MeshShape) -> Part:
    if isinstance(shape, MeshShape):
        return shape.part()
    return Part(shape.geometry, shape.mass, np.diag(shape.inertia), np.zeros(3))
