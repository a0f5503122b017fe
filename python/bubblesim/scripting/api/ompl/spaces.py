# SPDX-License-Identifier: BSD-3-Clause
"""The state spaces of simOMPL: what OMPL knows of them, and how their states are set in the scene."""

from __future__ import annotations

import importlib
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

POSITION_2D, POSE_2D, POSITION_3D, POSE_3D, JOINT, DUBINS, CYCLIC_JOINT = range(1, 8)
_DIMENSIONS = {POSITION_2D: 2, POSE_2D: 3, POSITION_3D: 3, POSE_3D: 7, JOINT: 1, DUBINS: 3, CYCLIC_JOINT: 1}
_BOUNDED = {POSITION_2D: 2, POSE_2D: 2, POSITION_3D: 3, POSE_3D: 3, JOINT: 1, DUBINS: 2, CYCLIC_JOINT: 0}


def ompl(part: str) -> Any:
    """Return a part of OMPL's Python module: base, geometric or util."""
    try:
        return importlib.import_module(f"ompl.{part}")
    except ImportError as error:
        raise RuntimeError(
            f"simOMPL needs the Python package ompl ({error}): run `scripts/setup --with planning`"
        ) from error


@dataclass(frozen=True)
class Space:
    """A part of a task's state: the position or pose of an object, or the position of a joint."""

    kind: int
    handle: int
    """Of the object or joint."""
    lower: list[float]
    upper: list[float]
    """Bounds of the position, m or rad."""
    weight: float
    """Of its distances."""
    frame: int
    """Positions and poses are relative to this object; -1 for the world."""
    turning_radius: float = 0.05
    """m, of DUBINS."""
    is_symmetric: bool = False
    """Whether a DUBINS path may be driven backwards."""

    def __post_init__(self) -> None:
        """Check kind and bounds."""
        if self.kind not in _DIMENSIONS:
            raise ValueError(f"{self.kind} is not a state space: use simOMPL.StateSpaceType.position2d ...")
        wanted = _BOUNDED[self.kind]
        if len(self.lower) < wanted or len(self.upper) < wanted:
            raise ValueError(
                f"the space needs {wanted} lower and {wanted} upper bounds, found {self.lower}, {self.upper}"
            )
        if any(low >= high for low, high in zip(self.lower[:wanted], self.upper[:wanted], strict=True)):
            raise ValueError(f"the lower bounds must be below the upper ones, found {self.lower}, {self.upper}")

    @property
    def dimension(self) -> int:
        """How many numbers a state has."""
        return _DIMENSIONS[self.kind]

    def make(self) -> Any:
        """Return OMPL's space."""
        base = ompl("base")
        count = _BOUNDED[self.kind]
        made = {
            POSE_2D: base.SE2StateSpace,
            POSE_3D: base.SE3StateSpace,
            CYCLIC_JOINT: base.SO2StateSpace,
            DUBINS: lambda: base.DubinsStateSpace(self.turning_radius, self.is_symmetric),
        }.get(self.kind, lambda: base.RealVectorStateSpace(count))()
        if count:
            bounds = base.RealVectorBounds(count)
            for i in range(count):
                bounds.setLow(i, self.lower[i])
                bounds.setHigh(i, self.upper[i])
            made.setBounds(bounds)
        return made

    def write(self, state: Any, values: Sequence[float]) -> None:
        """Set OMPL's state."""
        if self.kind in (POSE_2D, DUBINS):
            state.setX(values[0])
            state.setY(values[1])
            state.setYaw(values[2])
        elif self.kind == POSE_3D:
            state.setXYZ(*values[:3])
            turn = state.rotation()
            turn.x, turn.y, turn.z, turn.w = values[3:]
        elif self.kind == CYCLIC_JOINT:
            state.value = values[0]
        else:
            for i, value in enumerate(values):
                state[i] = value

    def read(self, state: Any) -> list[float]:
        """Return the numbers of OMPL's state."""
        if self.kind in (POSE_2D, DUBINS):
            return [state.getX(), state.getY(), state.getYaw()]
        if self.kind == POSE_3D:
            turn = state.rotation()
            return [state.getX(), state.getY(), state.getZ(), turn.x, turn.y, turn.z, turn.w]
        if self.kind == CYCLIC_JOINT:
            return [state.value]
        return [float(state[i]) for i in range(self.dimension)]

    def place(self, sim: Any, values: Sequence[float]) -> None:
        """Move the object or joint in the scene."""
        if self.kind in (JOINT, CYCLIC_JOINT):
            sim.setJointPosition(self.handle, values[0])
        elif self.kind == POSE_3D:
            sim.setObjectPose(self.handle, list(values), self.frame)
        elif self.kind == POSITION_3D:
            sim.setObjectPosition(self.handle, list(values), self.frame)
        else:
            height = sim.getObjectPosition(self.handle, self.frame)[2]
            sim.setObjectPosition(self.handle, [*values[:2], height], self.frame)
            if self.kind != POSITION_2D:
                alpha, beta, _ = sim.getObjectOrientation(self.handle, self.frame)
                sim.setObjectOrientation(self.handle, [alpha, beta, values[2]], self.frame)

    def present(self, sim: Any) -> list[float]:
        """Return the state of the scene."""
        if self.kind in (JOINT, CYCLIC_JOINT):
            return [sim.getJointPosition(self.handle)]
        pose = sim.getObjectPose(self.handle, self.frame)
        if self.kind in (POSE_3D, POSITION_3D):
            return list(pose[: self.dimension])
        turn = sim.getObjectOrientation(self.handle, self.frame)[2]
        return [*pose[:2], turn][: self.dimension]
