# SPDX-License-Identifier: BSD-3-Clause
"""What an experiment is, and how it runs."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

Parameters = Mapping[str, Any]


@dataclass(frozen=True)
class Tolerance:
    """How far a measurement may be from the theory: the sum of both parts."""

    why: str
    absolute: float = 0.0  # in the unit of the experiment
    relative: float = 0.0

    def around(self, theory: float) -> float:
        """Return the tolerance in the unit of the experiment."""
        return self.absolute + self.relative * abs(theory)


@dataclass(frozen=True)
class Experiment:
    """A quantity whose value is known, measured in one scene or several.

    The docstring of `theory` has the formula and its source. `measure` takes an engine (`Ours`, `MuJoCo` or `PyBullet`;
    see ours.py for its functions) and the parameters of a case.
    """

    name: str
    title: str
    unit: str
    theory: Callable[..., float]
    measure: Callable[..., float]
    tolerance: Tolerance
    cases: tuple[Parameters, ...] = ({},)
    peers: tuple[str, ...] = ("MuJoCo", "PyBullet")
    ode: bool = True  # whether it has to agree with ODE's solver, too
    long: bool = False


@dataclass(frozen=True)
class Outcome:
    """One case of an experiment in one engine."""

    case: str
    theory: float
    measured: float
    tolerance: float

    @property
    def error(self) -> float:
        """Return the error; infinite without a measurement."""
        return self.measured - self.theory if math.isfinite(self.measured) else math.inf

    @property
    def holds(self) -> bool:
        """Return whether the error is within the tolerance."""
        return abs(self.error) <= self.tolerance


@dataclass(frozen=True)
class Result:
    """An experiment in one engine."""

    engine: str
    outcomes: tuple[Outcome, ...]
    seconds: float

    @property
    def worst(self) -> Outcome:
        """Return the case with the greatest error, in tolerances."""
        return max(self.outcomes, key=lambda outcome: abs(outcome.error) / outcome.tolerance)

    @property
    def failures(self) -> int:
        """Return how many cases are out of tolerance."""
        return sum(not outcome.holds for outcome in self.outcomes)


def case_name(case: Parameters) -> str:
    """Return a case in words."""
    return ", ".join(
        f"{key} {value:g}" if isinstance(value, float) else f"{key} {value}" for key, value in case.items()
    )


def run(experiment: Experiment, engine: Any, on_case: Callable[[str], None] = lambda case: None) -> Result:
    """Measure all cases in an engine, which is a class that takes a scene."""
    start = time.perf_counter()
    outcomes = []
    for case in experiment.cases:
        on_case(case_name(case))
        theory = experiment.theory(**case)
        try:
            measured = float(experiment.measure(engine, **case))
        except RuntimeError:  # the engine gave up: bubblesim.Diverged
            measured = math.nan
        outcomes.append(Outcome(case_name(case), theory, measured, experiment.tolerance.around(theory)))
    return Result(engine.name, tuple(outcomes), time.perf_counter() - start)


def product_of(**values: tuple[Any, ...]) -> tuple[Parameters, ...]:
    """Return the cases of all combinations."""
    cases: list[dict[str, Any]] = [{}]
    for key, choices in values.items():
        cases = [{**case, key: choice} for case in cases for choice in choices]
    return tuple(cases)


def lowest(holds: Callable[[float], bool], low: float, high: float, precision: float) -> float:
    """Return the lowest value for which `holds` is true, by bisection; it is true at `high` and above."""
    while high - low > precision:
        middle = (low + high) / 2
        low, high = (low, middle) if holds(middle) else (middle, high)
    return (low + high) / 2
