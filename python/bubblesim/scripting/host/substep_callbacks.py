# SPDX-License-Identifier: BSD-3-Clause
"""Calls sysCall_dyn, sysCall_joint and sysCall_contact in the physics substeps, while scripts define them."""

from __future__ import annotations

import math
from typing import Any

from bubblesim._core import SubstepCall, set_contact_filter
from bubblesim.scene_state.object_tree import acting_object
from bubblesim.scene_state.scene_edits import SceneEdits
from bubblesim.scripting.host.child_script import ChildScript
from bubblesim.scripting.host.joint_callback import drive, joint_data

_FRICTION = ("mu", "friction", "kineticFriction")  # as CoppeliaSim names it for ODE, Bullet and Newton
_ANSWERS = {"ignoreContact", "collisionResponse", *_FRICTION}


class SubstepCallbacks:
    """A world without such scripts is not slowed down."""

    def __init__(self, runner: Any, edits: SceneEdits) -> None:
        """Bind to the simulation of a runner."""
        self._runner = runner
        self._simulation = runner.simulation
        self._edits = edits
        self._scripts: dict[str, list[ChildScript]] = {}
        self._call: SubstepCall | None = None
        self._has_filter = False
        self._pass = 0  # of the present step, from 1
        self._seconds = 0.0  # of a substep
        self._driven: list[int] = []  # joints of the scene's file that a callback drives
        self._first: set[int] = set()  # joints whose callback was not called yet

    def prepare(self, scripts: list[ChildScript]) -> None:
        """Begin and end the calls for these scripts; call it between substeps."""
        world = self._simulation.world
        names = ("sysCall_dyn", "sysCall_joint", "sysCall_contact")
        self._scripts = {name: [script for script in scripts if script.has_hook(name)] for name in names}
        in_substeps = bool(self._scripts["sysCall_dyn"] or self._scripts["sysCall_joint"])
        if in_substeps and self._call is None:
            self._call = SubstepCall(world, self._before_substep)
        elif not in_substeps and self._call is not None:
            self._call.remove()
            self._call = None
        if bool(self._scripts["sysCall_contact"]) != self._has_filter:
            self._has_filter = not self._has_filter
            set_contact_filter(world, self._lets_touch if self._has_filter else None)
        joints = self._simulation.objects if self._scripts["sysCall_joint"] else []
        handles = [int(each.handle) for each in joints if str(world.kind(each.handle)) == "joint"]
        self._driven = [joint for joint in handles if world.is_driven_by_callback(joint)]
        self._first = set(handles)

    def begin_step(self) -> None:
        """Count the passes of a step from its beginning."""
        self._pass = 0

    def end_step(self) -> None:
        """Report the end of the last pass of a step."""
        if self._pass and self._scripts.get("sysCall_dyn"):
            self._report_pass(after=True)

    def _before_substep(self, time: float, seconds: float) -> None:
        if self._scripts["sysCall_dyn"]:
            if self._pass:
                self._report_pass(after=True)
            self._pass += 1
            self._seconds = seconds
            self._report_pass(after=False)
        else:
            self._pass += 1
            self._seconds = seconds
        if self._scripts["sysCall_joint"]:
            given = self._edits.callback_joints
            for joint in dict.fromkeys([*self._driven, *sorted(given)]):
                if given.get(joint, True):
                    self._drive(joint)

    def _about_pass(self) -> dict[str, Any]:
        return {
            "passCnt": self._pass,
            "totalPasses": max(1, round(self._simulation.time_step / self._seconds)),
            "rk4pass": 0,
            "dt": self._seconds,
            "dynStepSize": self._seconds,  # name of older versions
        }

    def _report_pass(self, *, after: bool) -> None:
        for script in self._scripts["sysCall_dyn"]:
            script.answer("sysCall_dyn", {**self._about_pass(), "afterStep": after})

    def _drive(self, joint: int) -> None:
        """Ask the scripts of a joint and of its ancestors, until one answers."""
        world = self._simulation.world
        if not world.contains(joint):
            return
        data: dict[str, Any] = {}
        for script in self._above(joint, "sysCall_joint"):
            data = data or {**joint_data(world, joint), **self._about_pass(), "first": joint in self._first}
            if drive(world, joint, script.answer("sysCall_joint", data)):
                break
        self._first.discard(joint)

    def _above(self, handle: int, hook: str) -> list[ChildScript]:
        by_object = {
            acting_object(self._simulation.world, script.object_handle): script for script in self._scripts[hook]
        }
        found = []
        while handle >= 0:
            if handle in by_object:
                found.append(by_object[handle])
            handle = int(self._simulation.world.parent(handle))
        return found

    def _lets_touch(self, first: int, second: int) -> tuple[bool, float | None]:
        """Return whether two links that touch resist each other, and their friction; None: that of their surfaces."""
        handles = [self._shown(first), self._shown(second)]
        for script in self._scripts["sysCall_contact"]:
            answer = script.answer("sysCall_contact", {"handle1": handles[0], "handle2": handles[1], "engine": 1})
            if isinstance(answer, dict) and not _ANSWERS.isdisjoint(answer):
                resist = not answer.get("ignoreContact") and bool(answer.get("collisionResponse", True))
                return resist, _friction(answer)
        return True, None

    def _shown(self, link: int) -> int:
        """Return the handle of a created shape in place of that of its link."""
        model = int(self._simulation.world.outermost_model_of(link))
        return self._edits.known_handle(model) if model in self._edits.shapes else link


def _friction(answer: dict[str, Any]) -> float | None:
    """Return the coefficient that a contact callback has answered; None if it is none."""
    found = next((answer[name] for name in _FRICTION if name in answer), None)
    return float(found) if isinstance(found, int | float) and 0 <= found < math.inf else None
