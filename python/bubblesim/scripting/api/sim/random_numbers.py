# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that draw random numbers."""

from __future__ import annotations

import random
from typing import Any

from bubblesim.scripting.api.sim.context import ApiContext
from bubblesim.scripting.caller import Caller


class RandomFunctions(ApiContext):
    """Random numbers follow from the simulation's seed and the script's object: a run can be repeated."""

    def __init__(self, simulation: Any, caller: Caller) -> None:
        """Bind the functions to one script."""
        super().__init__(simulation, caller)
        self._random = random.Random(f"{simulation.seed} {caller.object_path}")

    def getRandom(self, seed: int | None = None) -> float:
        """A number from 0 up to below 1; a ``seed`` starts the script's sequence of numbers anew."""
        if seed is not None:
            self._random.seed(seed)
        return self._random.random()
