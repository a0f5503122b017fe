# SPDX-License-Identifier: BSD-3-Clause
"""Result files of a sweep: CSV or Parquet, a row for each run in the order of the tasks."""

from __future__ import annotations

import csv
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from bubblesim.sweeps.tasks import Outcome, Result, SweepError, Task

Row = dict[str, Result]


def rows_of(tasks: Sequence[Task], outcomes: Mapping[Task, Outcome]) -> list[Row]:
    """Return seed, parameters and results of the runs; with a column `error` if one failed."""
    found = [outcomes[task] for task in tasks]
    names = list(dict.fromkeys(name for outcome in found for name in outcome.results))
    errors = any(outcome.error for outcome in found)
    rows = []
    for task, outcome in zip(tasks, found, strict=True):
        row: Row = {"seed": task.seed, **dict(task.parameters)}
        row.update((name, outcome.results.get(name)) for name in names)
        if errors:
            row["error"] = outcome.error.splitlines()[-1] if outcome.error else None
        rows.append(row)
    return rows


def writer_of(file: Path) -> Callable[[Sequence[Row], Path], None]:
    """Return the function that writes a file of this name. Raise SweepError if there is none."""
    if file.suffix == ".csv":
        return write_csv
    if file.suffix == ".parquet":
        try:
            import pyarrow.parquet  # noqa: F401
        except ImportError as error:
            raise SweepError(
                f"{file}: Parquet needs pyarrow; to install it: pip install 'pyarrow<22'; or choose .csv"
            ) from error
        return write_parquet
    raise SweepError(f"{file}: the results are .csv or .parquet")


def write_csv(rows: Sequence[Row], file: Path) -> None:
    """Write CSV (RFC 4180); numbers have all their digits, a missing value is empty."""
    part = file.with_name(file.name + ".part")
    try:
        with part.open("w", newline="", encoding="utf-8") as stream:
            writer = csv.DictWriter(stream, list(rows[0]) if rows else ["seed"], lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
        part.replace(file)
    except OSError as error:
        raise SweepError(f"cannot write {file}: {error.strerror}") from error


def write_parquet(rows: Sequence[Row], file: Path) -> None:
    """Write Parquet, a column for each name."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    part = file.with_name(file.name + ".part")
    try:
        columns = {name: pa.array([row[name] for row in rows]) for name in rows[0]}
    except pa.ArrowException as error:
        raise SweepError(f"{file}: each column of a Parquet file has one type: {error}; .csv has not") from error
    try:
        pq.write_table(pa.table(columns), part)
        part.replace(file)
    except OSError as error:
        raise SweepError(f"cannot write {file}: {error}") from error
