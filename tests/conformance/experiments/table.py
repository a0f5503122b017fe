# SPDX-License-Identifier: BSD-3-Clause
"""Results as text, JSON and a table in Markdown."""

from __future__ import annotations

import dataclasses
import json
import math
import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from .experiment import Experiment, Outcome, Result


def number(value: float) -> str:
    """Return a number with four digits, or "-" for one that is not finite."""
    if not math.isfinite(value):
        return "-"
    if abs(value) < 1e-99:
        return "0"
    return f"{value:.3e}" if abs(value) < 1e-3 else f"{value:.4g}"


def outcome_text(outcome: Outcome) -> str:
    """Return one case in a line."""
    mark = "ok  " if outcome.holds else "FAIL"
    return (
        f"{mark} theory {number(outcome.theory):>9}  measured {number(outcome.measured):>9}  "
        f"error {number(outcome.error):>10}  tolerance {number(outcome.tolerance):>9}  {outcome.case}"
    )


def row_text(experiment: Experiment, results: Sequence[Result], *, all_cases: bool) -> str:
    """Return the rows of an experiment: its worst case in each engine."""
    unit = f" ({experiment.unit})" if experiment.unit else ""
    lines = [f"{experiment.name}: {experiment.title}{unit}"]
    for result in results:
        count = f"{len(result.outcomes) - result.failures}/{len(result.outcomes)}"
        lines.append(f"  {result.engine:10} {count:>6} {outcome_text(result.worst)}  [{result.seconds:.1f} s]")
        if all_cases:
            lines += [f"{'':20}{outcome_text(outcome)}" for outcome in result.outcomes]
    return "\n".join(lines)


def to_json(path: str, results: Mapping[str, Sequence[Result]]) -> None:
    """Write all cases of all engines."""
    content = {
        name: {
            result.engine: {
                "seconds": round(result.seconds, 2),
                "cases": [dataclasses.asdict(outcome) for outcome in result.outcomes],
            }
            for result in of_engines
        }
        for name, of_engines in results.items()
    }
    Path(path).write_text(json.dumps(content, indent=1) + "\n")


def from_json(path: str) -> dict[str, dict[str, Result]]:
    """Read what `to_json` wrote."""
    content = json.loads(Path(path).read_text())
    return {
        name: {
            engine: Result(engine, tuple(Outcome(**case) for case in result["cases"]), result["seconds"])
            for engine, result in engines.items()
        }
        for name, engines in content.items()
    }


def cell(outcome: Outcome | None) -> str:
    """Return a measurement; bold if it is out of tolerance."""
    if outcome is None:
        return ""
    return number(outcome.measured) if outcome.holds else f"**{number(outcome.measured)}**"


def same_case(results: Mapping[str, Result], engine: str, case: str) -> Outcome | None:
    """Return the outcome of a case in an engine."""
    outcomes = results[engine].outcomes if engine in results else ()
    return next((outcome for outcome in outcomes if outcome.case == case), None)


def markdown(
    path: str, experiments: Sequence[Experiment], results: Mapping[str, Sequence[Result]], before: str | None
) -> None:
    """Write a table with each experiment's worst case in bubblesim, before and now, and in the other engines.

    A file that has such a table gets the new one instead.
    """
    former = from_json(before) if before else {}
    head = [
        "Experiment",
        "Unit",
        "Case",
        "Theory",
        "Tolerance",
        *(["Before"] if before else []),
        "bubblesim",
        "ODE",
        "MuJoCo",
    ]
    lines = ["| " + " | ".join([*head, "PyBullet"]) + " |", "|" + "---|" * (len(head) + 1)]
    for experiment in experiments:
        if experiment.name not in results:
            continue
        engines = {result.engine: result for result in results[experiment.name]}
        old = former.get(experiment.name, {})
        # The case in which the former version was worst shows what has changed.
        worst = (old.get("bubblesim") if old else None) or engines["bubblesim"]
        shown = worst.worst.case
        if engines["bubblesim"].failures:
            shown = engines["bubblesim"].worst.case
        now = same_case(engines, "bubblesim", shown) or engines["bubblesim"].worst
        cells = [experiment.title, experiment.unit, now.case, number(now.theory), number(now.tolerance)]
        if before:
            cells.append(cell(same_case(old, "bubblesim", now.case)))
        others = [
            same_case(engines, name, now.case) or same_case(old, name, now.case)
            for name in ("ODE", "MuJoCo", "PyBullet")
        ]
        cells += [cell(now), *map(cell, others)]
        lines.append("| " + " | ".join(cells) + " |")
    table, file = "\n".join(lines) + "\n", Path(path)
    page = file.read_text() if file.exists() else ""
    replaced, count = re.subn(r"^\| Experiment \|.*\n(?:\|.*\n)*", lambda match: table, page, flags=re.MULTILINE)
    file.write_text(replaced if count else table)
