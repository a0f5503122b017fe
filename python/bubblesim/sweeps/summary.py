# SPDX-License-Identifier: BSD-3-Clause
"""Summary of a sweep: for each combination of the parameters, mean and standard deviation of each result."""

from __future__ import annotations

import math
import statistics
from collections.abc import Sequence
from dataclasses import dataclass, field

from bubblesim.sweeps.results import Row
from bubblesim.sweeps.tasks import Result

_LINES = 40  # of the table


@dataclass
class Group:
    """The runs of one combination of parameters."""

    parameters: tuple[Result, ...]
    runs: int = 0
    failed: int = 0
    samples: dict[str, list[float]] = field(default_factory=dict)  # of each result; true is 1, false 0


def grouped(rows: Sequence[Row], parameters: Sequence[str]) -> list[Group]:
    """Group the runs by the parameters, in the order of the runs."""
    groups: dict[tuple[Result, ...], Group] = {}
    names = numeric_results(rows, parameters)
    for row in rows:
        key = tuple(row[name] for name in parameters)
        group = groups.setdefault(key, Group(key))
        group.runs += 1
        group.failed += row.get("error") is not None
        for name in names:
            value = row[name]
            if isinstance(value, int | float) and math.isfinite(value):
                group.samples.setdefault(name, []).append(float(value))
    return list(groups.values())


def numeric_results(rows: Sequence[Row], parameters: Sequence[str]) -> list[str]:
    """Return the names of the results that are numbers."""
    if not rows:
        return []
    names = [name for name in rows[0] if name not in ("seed", "error", *parameters)]
    return [name for name in names if any(isinstance(row[name], int | float) for row in rows[:1000])]


def table(rows: Sequence[Row], parameters: Sequence[str]) -> str:
    """Return the summary as a table of text: mean ± standard deviation over the runs."""
    names = numeric_results(rows, parameters)
    groups = grouped(rows, parameters)
    failed = any(group.failed for group in groups)
    lines = [[*parameters, "runs", *(["failed"] if failed else []), *names]]
    for group in groups[:_LINES]:
        cells = [*map(str, group.parameters), str(group.runs), *([str(group.failed)] if failed else [])]
        lines.append([*cells, *(_mean(group.samples.get(name, [])) for name in names)])
    widths = [max(len(line[column]) for line in lines) for column in range(len(lines[0]))]
    text = ["  ".join(cell.rjust(width) for cell, width in zip(line, widths, strict=True)) for line in lines]
    if len(groups) > _LINES:
        text.append(f"... and {len(groups) - _LINES} more combinations")
    return "\n".join(text)


def _mean(samples: list[float]) -> str:
    if not samples:
        return "-"
    mean = f"{statistics.fmean(samples):.4g}"
    return mean if len(samples) == 1 else f"{mean} ± {statistics.stdev(samples):.2g}"
