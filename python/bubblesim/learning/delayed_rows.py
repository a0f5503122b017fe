# SPDX-License-Identifier: BSD-3-Clause
"""Delays of the actions and observations of many worlds."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from bubblesim._core import Distribution

Array = npt.NDArray[Any]

_LONGEST = 10_000  # calls


class DelayedRows:
    """Returns rows, one for each world, some calls after they came in.

    >>> late = DelayedRows(len(batch), Distribution.choice([0, 1, 2]), name="actions")
    >>> late.restart(np.zeros((len(batch), 2)), seeds)
    >>> batch.step(late(actions))
    """

    def __init__(self, worlds: int, delay: Distribution | int, *, name: str) -> None:
        """Begin without rows; ``restart`` comes first.

        :param delay: in calls; a Distribution is drawn for each world, and rounded.
        :param name: what the drawn delay depends on, beside the seed of the world.
        """
        self._delay = Distribution.choice([float(delay)]) if isinstance(delay, int) else delay
        self._name = name
        self.delays: npt.NDArray[np.int64] = np.zeros(worlds, dtype=np.int64)
        """In calls, of each world."""
        self._rows: Array = np.zeros((1, worlds, 0))  # the last ones; that of call n is at n modulo their number
        self._calls = 0

    def restart(self, rows: Array, seeds: Sequence[int] | Array, mask: Array | None = None) -> None:
        """Begin anew in some worlds, with rows that stand for all those before.

        :param rows: an array with a row of any shape for each world.
        :param seeds: of each world.
        :param mask: bool for each world; None: all.
        :raises ValueError: if a drawn delay is negative or longer than 10,000 calls.
        """
        worlds = np.arange(len(self.delays)) if mask is None else np.flatnonzero(mask)
        for world in map(int, worlds):
            drawn = round(self._delay.draw(int(seeds[world]), self._name)[0])
            if not 0 <= drawn <= _LONGEST:
                raise ValueError(f"the delay of the {self._name} is {drawn} calls, it must be from 0 to {_LONGEST}")
            self.delays[world] = drawn
        needed = int(self.delays.max(initial=0)) + 1
        if self._rows.shape != (needed, *rows.shape) or self._rows.dtype != rows.dtype:
            self._resize(needed, rows)
        self._rows[:, worlds] = rows[worlds]

    def __call__(self, rows: Array) -> Array:
        """Take a row of each world, and return that of ``delays`` calls ago."""
        self._calls += 1
        self._rows[self._calls % len(self._rows)] = rows
        return self.last()

    def last(self) -> Array:
        """Return the rows of the last call or restart again."""
        worlds = np.arange(len(self.delays))
        return np.asarray(self._rows[(self._calls - self.delays) % len(self._rows), worlds])

    def _resize(self, needed: int, rows: Array) -> None:
        """Keep the last rows of the worlds that go on."""
        before, self._rows = self._rows, np.repeat(rows[None], needed, axis=0)
        if before.shape[2:] != rows.shape[1:]:
            return
        for age in range(min(needed, len(before))):
            self._rows[(self._calls - age) % needed] = before[(self._calls - age) % len(before)]
