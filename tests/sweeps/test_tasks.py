# SPDX-License-Identifier: BSD-3-Clause
"""Seeds, values of parameters, and the runs that they make."""

import pytest

from bubblesim.sweeps.tasks import SweepError, Task, parse_seeds, parse_setting, tasks_of


@pytest.mark.parametrize(
    ("text", "seeds"), [("0:3", [0, 1, 2]), ("7", [7]), ("1,5,9", [1, 5, 9]), (str(2**64 - 1), [2**64 - 1])]
)
def test_seeds_are_a_range_without_its_end_or_a_list(text: str, seeds: list[int]) -> None:
    assert parse_seeds(text) == seeds


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "found ''"),
        ("-1", "from 0 on"),
        ("3:3", "empty"),
        ("1.5", "found '1.5'"),
        ("1,1", "given twice"),
        (str(2**64), "less than"),
        ("0:99999999999", "at most"),
    ],
)
def test_bad_seeds_are_refused(text: str, reason: str) -> None:
    with pytest.raises(SweepError, match=reason):
        parse_seeds(text)


def test_a_range_of_values_has_its_last_one_and_no_rounding_errors() -> None:
    name, values = parse_setting("/Robot.mass=1:2:0.1")
    assert name == "/Robot.mass"
    assert values == [1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9, 2.0]
    assert parse_setting("n=3:1:-1") == ("n", [3, 2, 1])
    assert parse_setting("n=0:1:0.4") == ("n", [0, 0.4, 0.8])


def test_a_list_of_values_has_numbers_and_words() -> None:
    assert parse_setting("planner=fast,slow") == ("planner", ["fast", "slow"])
    assert parse_setting("x=1,2.5,-3e2") == ("x", [1, 2.5, -300.0])
    assert parse_setting("file=a:b") == ("file", ["a:b"])


@pytest.mark.parametrize(("text", "kind"), [("x=1,2", int), ("x=1,2.5", float), ("x=1,a", str), ("x=0:1:0.5", float)])
def test_the_values_of_a_parameter_have_one_type(text: str, kind: type) -> None:
    assert {type(value) for value in parse_setting(text)[1]} == {kind}


@pytest.mark.parametrize("text", ["", "x", "x=", "=1", "x=1:2:0", "x=1:2:-1", "x=1,1", "x=0:1e9:1e-3"])
def test_bad_values_are_refused(text: str) -> None:
    with pytest.raises(SweepError):
        parse_setting(text)


def test_the_seed_changes_fastest_then_the_last_parameter() -> None:
    tasks = tasks_of([0, 1], {"a": [1, 2], "b": ["x"]})
    assert tasks == [Task(seed, (("a", a), ("b", "x"))) for a in (1, 2) for seed in (0, 1)]
    with pytest.raises(SweepError, match="at most"):
        tasks_of(range(10**6), {"a": list(range(100))})
