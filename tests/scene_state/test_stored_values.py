# SPDX-License-Identifier: BSD-3-Clause
"""The limits of signals and other named values."""

import pytest

from bubblesim.scene_state.stored_values import MOST_BYTES, MOST_VALUES, StoredValues


@pytest.fixture
def values() -> StoredValues[str]:
    return StoredValues("signals")


def test_values_are_kept_in_their_order(values: StoredValues[str]) -> None:
    values["b"], values["a"] = [1.5], None
    values["b"] = "text"
    assert list(values.items()) == [("b", "text"), ("a", None)]
    del values["b"]
    assert values.get("b") is None
    assert len(values) == 1
    with pytest.raises(KeyError):
        del values["b"]


def test_the_size_of_all_has_a_limit(values: StoredValues[str]) -> None:
    values["one"] = bytes(MOST_BYTES // 2)
    why = (
        r"the signals of the scene would have more than 128 MiB together.*; 64\.0 MiB are in use by others: clear some"
    )
    with pytest.raises(ValueError, match=why):
        values["two"] = {"table": [bytes(MOST_BYTES // 4), bytes(MOST_BYTES // 4)]}
    with pytest.raises(ValueError, match="128 MiB"):
        values["x" * (MOST_BYTES // 2)] = 1.0
    values["one"] = bytes(MOST_BYTES - 10_000)
    values.clear()
    values["two"] = bytes(MOST_BYTES - 10_000)
    del values["two"]
    values["three"] = bytes(MOST_BYTES - 10_000)


def test_the_number_of_values_has_a_limit(values: StoredValues[str]) -> None:
    for number in range(MOST_VALUES):
        values[str(number)] = 1.0
    with pytest.raises(ValueError, match="the scene already has 100000 signals, the most that it can hold: clear some"):
        values["one more"] = 1.0
    values["0"] = 2.0


def test_a_table_that_contains_itself_does_not_fit(values: StoredValues[str]) -> None:
    table: list[object] = []
    table += [table, table]
    with pytest.raises(ValueError, match="128 MiB"):
        values["table"] = table
