# SPDX-License-Identifier: BSD-3-Clause
"""Delays of the actions and observations of many worlds."""

import numpy as np
import pytest

from bubblesim import Distribution
from bubblesim.learning.delayed_rows import DelayedRows


def rows(call: int) -> np.ndarray:
    """Return rows that show the call and the world."""
    return np.array([[100 * call + world, -call] for world in range(3)])


def test_each_world_has_its_own_delay() -> None:
    late = DelayedRows(3, Distribution.choice([0, 1, 2]), name="actions")
    seeds = np.arange(3)
    late.restart(rows(0), seeds)
    assert len(set(late.delays.tolist())) > 1
    for call in range(1, 8):
        found = late(rows(call))
        for world, delay in enumerate(late.delays):
            assert found[world].tolist() == rows(max(0, call - int(delay)))[world].tolist()


def test_a_restart_of_one_world_leaves_the_others() -> None:
    late = DelayedRows(3, 2, name="actions")
    late.restart(rows(0), [0, 0, 0])
    for call in range(1, 5):
        late(rows(call))
    late.restart(rows(9), [0, 0, 0], np.array([False, True, False]))
    assert late.last().tolist() == [rows(2)[0].tolist(), rows(9)[1].tolist(), rows(2)[2].tolist()]
    assert late(rows(5)).tolist() == [rows(3)[0].tolist(), rows(9)[1].tolist(), rows(3)[2].tolist()]
    late(rows(6))
    assert late(rows(7))[1].tolist() == rows(5)[1].tolist()


def test_a_longer_delay_after_a_restart_keeps_what_others_wait_for() -> None:
    delay = Distribution.uniform(0, 30)
    late = DelayedRows(3, delay, name="actions")
    late.restart(rows(0), [1, 2, 3])
    for call in range(1, 40):
        late(rows(call))
    seed = next(seed for seed in range(100) if round(delay.draw(seed, "actions")[0]) > late.delays.max())
    late.restart(rows(0), [seed] * 3, np.array([True, False, False]))
    found = late(rows(40))
    for world in (1, 2):
        assert found[world].tolist() == rows(40 - int(late.delays[world]))[world].tolist()


@pytest.mark.parametrize("delay", [-1, 100_000])
def test_a_delay_that_cannot_be_is_refused(delay: int) -> None:
    with pytest.raises(ValueError, match=r"the delay of the actions is .* calls, it must be from 0 to 10000"):
        DelayedRows(3, delay, name="actions").restart(rows(0), [0, 0, 0])
