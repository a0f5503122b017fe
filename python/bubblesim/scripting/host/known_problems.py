# SPDX-License-Identifier: BSD-3-Clause
"""The problems of a scene and its scripts, kept for readers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from bubblesim.scene_state.problems import Problem, of_scene

_MOST = 100  # of one script


class KnownProblems:
    """Warnings of the scene's files, and the problems of each script since it was loaded."""

    def __init__(self, warnings: Sequence[str]) -> None:
        """Take the warnings of a Scene."""
        self._of_scene = [of_scene(warning) for warning in warnings]
        self._of_scripts: dict[str, list[Problem]] = {}  # by object path
        self._revision = 1

    def add(self, problem: Problem) -> None:
        """Add a problem of a script."""
        known = self._of_scripts.setdefault(problem.object, [])
        if len(known) < _MOST:
            known.append(problem)
            self._revision += 1

    def forget(self, path: str) -> None:
        """Forget the problems of the script of an object, which is loaded again."""
        if self._of_scripts.pop(path, None):
            self._revision += 1

    def described(self) -> dict[str, Any]:
        """Return the result of sim.getProblems."""
        every = [*(each for known in self._of_scripts.values() for each in known), *self._of_scene]
        return {"revision": self._revision, "problems": [asdict(each) for each in every]}
