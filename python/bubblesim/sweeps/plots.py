# SPDX-License-Identifier: BSD-3-Clause
"""Plots of a sweep: each result over the first swept parameter, or its distribution if there is none."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np

from bubblesim.sweeps.results import Row
from bubblesim.sweeps.summary import grouped, numeric_results
from bubblesim.sweeps.tasks import SweepError

mpl.use("Agg")  # no display needed

from matplotlib import pyplot as plt

_MOST_LINES = 10


def plot(rows: Sequence[Row], parameters: Sequence[str], file: Path) -> None:
    """Draw one plot for each numeric result: the mean over the seeds, with a band from the 10th to the 90th percentile.

    :param parameters: the swept ones; the first is the horizontal axis, the others distinguish lines.
    :raises SweepError: when there is nothing to plot, or the file cannot be written.
    """
    names = numeric_results(rows, parameters)
    if not names:
        raise SweepError(f"{file} is not drawn: the runs returned no numbers")
    figure, all_axes = plt.subplots(
        len(names), squeeze=False, figsize=(7.0, 2.8 * len(names)), dpi=110, layout="constrained"
    )
    for name, axes in zip(names, all_axes[:, 0], strict=True):
        if parameters:
            _draw_lines(axes, rows, parameters, name)
        else:
            values = [row[name] for row in rows if isinstance(row[name], int | float)]
            axes.hist(np.asarray(values, dtype=float), bins="auto", color="#3b6ea5")
            axes.set(xlabel=name, ylabel="runs")
        axes.grid(color="#e8e8e8", linewidth=0.6)
        axes.set_axisbelow(True)
    try:
        figure.savefig(file)
    except (OSError, ValueError) as error:  # ValueError: a suffix that matplotlib does not know
        raise SweepError(f"cannot write {file}: {error}") from error
    finally:
        plt.close(figure)


def _draw_lines(axes: Any, rows: Sequence[Row], parameters: Sequence[str], name: str) -> None:
    lines: dict[tuple[Any, ...], list[tuple[Any, list[float]]]] = {}
    for group in grouped(rows, parameters):
        if name in group.samples:
            lines.setdefault(group.parameters[1:], []).append((group.parameters[0], group.samples[name]))
    for others, points in list(lines.items())[:_MOST_LINES]:
        across = [value for value, _ in points]
        if any(isinstance(value, str) for value in across):
            across = [str(value) for value in across]
        label = ", ".join(f"{key}={value}" for key, value in zip(parameters[1:], others, strict=True))
        (line,) = axes.plot(across, [np.mean(samples) for _, samples in points], "o-", markersize=3, label=label)
        low, high = (np.array([np.percentile(samples, level) for _, samples in points]) for level in (10, 90))
        axes.fill_between(across, low, high, color=line.get_color(), alpha=0.2, linewidth=0)
    if len(parameters) > 1:
        axes.legend(fontsize="small")
    axes.set(xlabel=parameters[0], ylabel=name)
