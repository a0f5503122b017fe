# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for random numbers."""

from __future__ import annotations

import random
from typing import Any

from bubblesim.scripting.api.sim.context import ApiContext
from bubblesim.scripting.caller import Caller


class RandomFunctions(ApiContext):
    """Random numbers depend only on the random seed and the script's object, so runs are reproducible."""

    def __init__(self, runner: Any, caller: Caller) -> None:
        """Bind the functions to one script."""
        super().__init__(runner, caller)
        self._random = random.Random(f"{runner.simulation.seed} {caller.object_path}")

    def getRandom(self, seed: int | None = None) -> float:
        """Return a number from 0 to less than 1; a ``seed`` restarts the script's sequence of numbers."""
        if seed is not None:
            self._random.seed(seed)
        return self._random.random()
