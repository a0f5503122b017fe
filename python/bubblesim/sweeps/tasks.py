# SPDX-License-Identifier: BSD-3-Clause
"""The runs of a sweep: every combination of the parameters' values, each with every seed."""

from __future__ import annotations

import itertools
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from decimal import Decimal, InvalidOperation

Value = int | float | str
"""Of a parameter."""
Result = int | float | str | bool | None
"""A value that a run returns."""
MOST = 10_000_000  # runs of one sweep


class SweepError(ValueError):
    """A sweep cannot run; the text states why."""


@dataclass(frozen=True)
class Task:
    """One run."""

    seed: int
    parameters: tuple[tuple[str, Value], ...] = ()  # names and values, in the order in which they were given


@dataclass(frozen=True)
class Outcome:
    """What a run returned, or the error that ended it."""

    results: Mapping[str, Result] = field(default_factory=dict)
    error: str = ""


def tasks_of(seeds: Sequence[int], parameters: Mapping[str, Sequence[Value]]) -> list[Task]:
    """Return the runs: the seed changes fastest, then the last parameter."""
    count = len(seeds)
    for values in parameters.values():
        count *= len(values)
    if count > MOST:
        raise SweepError(f"these are {count} runs; a sweep has at most {MOST}")
    combinations = itertools.product(*([(name, value) for value in values] for name, values in parameters.items()))
    return [Task(seed, combination) for combination in combinations for seed in seeds]


def parse_seeds(text: str) -> list[int]:
    """Read seeds: "0:1000" (0 to 999), "7", or "1,5,9"."""
    if bounds := re.fullmatch(r"(\d+):(\d+)", text):
        seeds: Sequence[int] = range(int(bounds[1]), int(bounds[2]))
    elif re.fullmatch(r"\d+(,\d+)*", text):
        seeds = [int(seed) for seed in text.split(",")]
    else:
        raise SweepError(f"seeds are FIRST:END or a list such as 1,5,9, of numbers from 0 on; found {text!r}")
    if not seeds:
        raise SweepError(f"the range of seeds {text} is empty: FIRST must be less than END")
    if len(seeds) > MOST:
        raise SweepError(f"these are {len(seeds)} seeds; a sweep has at most {MOST} runs")
    if max(seeds) >= 2**64:
        raise SweepError(f"seeds must be less than 2^64, found {max(seeds)}")
    _require_different(seeds, "seed")
    return list(seeds)


def parse_setting(text: str) -> tuple[str, list[Value]]:
    """Read "NAME=FIRST:LAST:STEP" (LAST is included) or "NAME=VALUE,VALUE,..."; return the name and the values."""
    name, equals, values = text.partition("=")
    if not (name and equals and values):
        raise SweepError(f"a parameter is NAME=FIRST:LAST:STEP or NAME=VALUE,VALUE,...; found {text!r}")
    parts = values.split(":")
    if len(parts) == 3 and all(map(_is_number, parts)):
        return name, _range(text, *map(Decimal, parts))
    found = _of_one_type(values.split(","))
    _require_different(found, name)
    return name, found


def _require_different(values: Sequence[Value], what: str) -> None:
    if len(set(values)) < len(values):
        repeated = next(value for value in values if values.count(value) > 1)
        raise SweepError(f"{what}: {repeated!r} is given twice")


def _is_number(text: str) -> bool:
    try:
        return Decimal(text).is_finite()
    except InvalidOperation:
        return False


def _of_one_type(strings: Sequence[str]) -> list[Value]:
    """Convert all to int, or all to float, or leave them as strings: columns of a table have one type."""
    if not all(map(_is_number, strings)):
        return list(strings)
    whole = all(re.fullmatch(r"[+-]?\d+", text) for text in strings)
    return [int(text) if whole else float(text) for text in strings]


def _range(text: str, first: Decimal, last: Decimal, step: Decimal) -> list[Value]:
    """Return first, first + step, ... up to last, as the nearest floats: without the sums of rounding errors."""
    if step == 0 or (last - first) / step < 0:
        raise SweepError(f"{text}: the step must lead from {first} to {last}")
    count = int((last - first) / step) + 1
    if count > MOST:
        raise SweepError(f"{text}: these are {count} values; a sweep has at most {MOST} runs")
    return _of_one_type([str(first + index * step) for index in range(count)])
