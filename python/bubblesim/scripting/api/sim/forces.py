# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that push models and links."""

from __future__ import annotations

from typing import Annotated, Any

from bubblesim.scripting.api.checked_calls import refusal_warns
from bubblesim.scripting.api.kinds import Handle, Kind, Vector3, numbers
from bubblesim.scripting.api.sim.context import ApiContext

ZERO = [0.0, 0.0, 0.0]


def _vector_or_nothing(value: Any) -> list[float]:
    vector: list[float] = ZERO if value is None else numbers(3).convert(value)
    return vector


OptionalVector3 = Annotated[list[float], Kind("3 numbers or nothing", _vector_or_nothing)]


class ForceFunctions(ApiContext):
    """Forces in N and torques in N m act during the next simulation step; several add up. On a model they act on its
    canonical link. sim.handleflag_resetforce and sim.handleflag_resettorque, added to the handle, remove what was added
    before for that step."""

    @refusal_warns
    def addForce(self, handle: Handle, position: Vector3, force: Vector3) -> None:
        """Push a model or link at a point; ``position`` and ``force`` are in its frame."""
        target = self._reset(handle)
        self._world.apply_wrench(target, force, point=position, local=True)

    @refusal_warns
    def addForceAndTorque(self, handle: Handle, force: OptionalVector3 = ZERO, torque: OptionalVector3 = ZERO) -> None:
        """Push a model or link at its centre of mass; ``force`` and ``torque`` are in world axes."""
        target = self._reset(handle)
        self._world.apply_wrench(target, force, torque)

    def _reset(self, handle: int) -> int:
        """Return the handle without its flags, after doing what they request."""
        if handle < 0:
            return self._resolve(handle)
        force, torque = (bool(handle & flag) for flag in (self.handleflag_resetforce, self.handleflag_resettorque))
        target = self._resolve(handle & ~self.handleflag_resetforcetorque)
        if force or torque:
            self._world.clear_wrench(target, force, torque)
        return target
