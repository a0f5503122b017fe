# SPDX-License-Identifier: BSD-3-Clause
"""benchmarks/barn drives through worlds in the format of the BARN challenge, and through its own where they are."""

import os
import sys
from pathlib import Path

import numpy as np
import pytest

from bubblesim.sweeps.local_workers import LocalWorkers
from bubblesim.sweeps.programs import FileProgram
from bubblesim.sweeps.sweep import run_sweep
from bubblesim.sweeps.tasks import tasks_of
from ros_support import REPOSITORY

PROGRAM = REPOSITORY / "benchmarks" / "barn" / "barn.py"
CYLINDER = """<model name='unit_cylinder_{n}'><static>1</static><pose frame=''>{x} {y} 0 0 0 0</pose>
<link name='link'><collision name='collision'><geometry><cylinder><radius>0.075</radius><length>1</length></cylinder>
</geometry></collision></link></model>"""


def write_world(folder: Path, cylinders: list[tuple[float, float]]) -> None:
    text = "\n".join(CYLINDER.format(n=n, x=x, y=y) for n, (x, y) in enumerate(cylinders))
    (folder / "world_0.world").write_text(f"<sdf version='1.6'><world name='default'>{text}</world></sdf>")
    (folder / "path_files").mkdir()
    np.save(folder / "path_files" / "path_0.npy", np.array([[15, row] for row in range(30)]))


def test_it_finds_the_gap_in_walls(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    gaps = {6.0: -3.5, 8.5: -1.0}  # y of a wall: x of its gap, 0.8 m wide
    walls = [(x, y) for y, gap in gaps.items() for x in np.arange(-4.5, 0.0, 0.1) if abs(x - gap) > 0.475]
    sides = [(x, y) for x in (-4.6, 0.1) for y in np.arange(2.0, 11.0, 0.1)]
    write_world(tmp_path, walls + sides)
    monkeypatch.setenv("BARN_WORLDS", str(tmp_path))
    program = FileProgram.read(PROGRAM)
    (row,) = run_sweep(program, tasks_of([0], {"world": [0]}), LocalWorkers(program, 1), tmp_path / "journal")
    assert (row["success"], row["collision"]) == (True, False), row
    assert 0.2 < float(row["metric"] or 0.0) <= 0.5


def test_the_reference_time_is_that_of_the_path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write_world(tmp_path, [(0.0, 20.0)])
    monkeypatch.setenv("BARN_WORLDS", str(tmp_path))
    monkeypatch.syspath_prepend(str(PROGRAM.parent))
    from worlds import optimal_time

    sys.modules.pop("worlds")
    ends = np.array([[-2.25, 3.0], [-2.325, 5.075], [-2.325, 9.425], [-2.25, 13.0]])
    assert optimal_time(0) == pytest.approx(np.linalg.norm(np.diff(ends, axis=0), axis=1).sum() / 2.0)


@pytest.mark.long
@pytest.mark.skipif("BARN_WORLDS" not in os.environ, reason="BARN_WORLDS does not name the challenge's worlds")
def test_it_reaches_the_goals_of_the_challenge(tmp_path: Path) -> None:
    program = FileProgram.read(PROGRAM)
    tasks = tasks_of([0], {"world": list(range(0, 300, 6))})
    rows = run_sweep(program, tasks, LocalWorkers(program, 2), tmp_path / "journal")
    assert sum(bool(row["success"]) for row in rows) / len(rows) >= 0.9
    assert sum(float(row["metric"] or 0.0) for row in rows) / len(rows) >= 0.2
