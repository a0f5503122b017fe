# SPDX-License-Identifier: BSD-3-Clause
"""Result files, the summary and the plots of a sweep."""

import csv
import math
from pathlib import Path

import pytest

from bubblesim.sweeps.plots import plot
from bubblesim.sweeps.results import Row, rows_of, write_csv, write_parquet, writer_of
from bubblesim.sweeps.summary import table
from bubblesim.sweeps.tasks import Outcome, SweepError, tasks_of

TASKS = tasks_of([0, 1], {"gain": [0.1, 0.3]})
OUTCOMES = {task: Outcome({"error_m": 0.1 + 0.2 * task.seed, "ok": task.seed == 0}) for task in TASKS}


def test_rows_are_in_the_order_of_the_tasks() -> None:
    shuffled = dict(reversed(OUTCOMES.items()))
    rows = rows_of(TASKS, shuffled)
    assert [(row["seed"], row["gain"]) for row in rows] == [(0, 0.1), (1, 0.1), (0, 0.3), (1, 0.3)]
    assert list(rows[0]) == ["seed", "gain", "error_m", "ok"]


def test_a_failed_run_has_its_last_line_in_a_column() -> None:
    rows = rows_of(TASKS, {**OUTCOMES, TASKS[1]: Outcome(error="Traceback\nValueError: no")})
    assert [row["error"] for row in rows] == [None, "ValueError: no", None, None]
    assert rows[1]["error_m"] is None
    assert "failed" in table(rows, ["gain"]).splitlines()[0]


def test_csv_keeps_all_digits(tmp_path: Path) -> None:
    file = tmp_path / "results.csv"
    rows: list[Row] = [{"seed": 0, "x": 0.1 + 0.2, "text": 'a "b",\nc', "none": None, "far": math.inf}]
    write_csv(rows, file)
    with file.open(newline="") as stream:
        (read,) = csv.DictReader(stream)
    assert float(read["x"]) == 0.1 + 0.2
    assert (read["text"], read["none"], read["far"]) == ('a "b",\nc', "", "inf")
    assert [entry.name for entry in tmp_path.iterdir()] == ["results.csv"]


def test_parquet_has_typed_columns(tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    file = tmp_path / "results.parquet"
    writer_of(file)(rows_of(TASKS, OUTCOMES), file)
    read = parquet.read_table(file)
    assert [str(kind) for kind in read.schema.types] == ["int64", "double", "double", "bool"]
    assert read.column("error_m").to_pylist() == [0.1, 0.1 + 0.2, 0.1, 0.1 + 0.2]
    with pytest.raises(SweepError, match="one type"):
        write_parquet([{"seed": 0, "x": 1}, {"seed": 1, "x": "a"}], file)


def test_another_suffix_is_refused(tmp_path: Path) -> None:
    with pytest.raises(SweepError, match=r"\.csv or \.parquet"):
        writer_of(tmp_path / "results.xls")


def test_parquet_without_pyarrow_names_the_package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "pyarrow", None)  # as if it were not installed
    monkeypatch.delitem(__import__("sys").modules, "pyarrow.parquet", raising=False)
    with pytest.raises(SweepError, match="pip install 'pyarrow"):
        writer_of(tmp_path / "results.parquet")


def test_summary_has_mean_and_standard_deviation() -> None:
    lines = table(rows_of(TASKS, OUTCOMES), ["gain"]).splitlines()
    assert lines[0].split() == ["gain", "runs", "error_m", "ok"]
    assert lines[1].split() == ["0.1", "2", "0.2", "±", "0.14", "0.5", "±", "0.71"]
    assert len(lines) == 3


def test_plots_are_pictures(tmp_path: Path) -> None:
    rows = rows_of(TASKS, OUTCOMES)
    for parameters, name in ((["gain"], "lines.png"), ([], "distribution.svg")):
        plot(rows, parameters, tmp_path / name)
        assert (tmp_path / name).stat().st_size > 1000
    with pytest.raises(SweepError, match="cannot write"):
        plot(rows, ["gain"], tmp_path / "lines.xyz")
    with pytest.raises(SweepError, match="no numbers"):
        plot([{"seed": 0, "word": "a"}], [], tmp_path / "none.png")
