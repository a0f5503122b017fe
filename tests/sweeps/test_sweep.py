# SPDX-License-Identifier: BSD-3-Clause
"""Sweeps in processes: results, failures, processes and drivers that are killed, journals."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from bubblesim.sweeps.local_workers import LocalWorkers
from bubblesim.sweeps.programs import FileProgram, SceneProgram
from bubblesim.sweeps.sweep import run_sweep
from bubblesim.sweeps.tasks import SweepError, tasks_of
from node_support import write
from ros_support import wait_until

TRICYCLE = """
def run(run):
    simulation = run.simulation("tricycle")
    simulation.step(20)
    x, y, _ = simulation.object("/Tricycle").position
    return {"x": x, "y": y, "hash": str(simulation.state_hash())}
"""
SPEEDS = {"/FrontMotor.target_velocity": [0.5, 1.0]}


def program(folder: Path, text: str) -> FileProgram:
    return FileProgram.read(write(folder / "program.py", text))


def test_results_do_not_depend_on_the_number_of_workers(tmp_path: Path) -> None:
    found = program(tmp_path, TRICYCLE)
    tasks = tasks_of(range(4), SPEEDS)
    results = [
        run_sweep(found, tasks, LocalWorkers(found, count), tmp_path / f"{count}.journal") for count in (1, 2, 3)
    ]
    assert results[0] == results[1] == results[2]
    assert len({row["x"] for row in results[0]}) == 2  # the speeds


def test_a_failing_run_is_reported_and_the_others_end(tmp_path: Path) -> None:
    found = program(tmp_path, "def run(run):\n    return {'inverse': 1 / run.seed}\n")
    rows = run_sweep(found, tasks_of([0, 1, 2], {}), LocalWorkers(found, 2), tmp_path / "j")
    assert [row["inverse"] for row in rows] == [None, 1.0, 0.5]
    assert rows[0]["error"] == "ZeroDivisionError: division by zero"
    assert "program.py" in (tmp_path / "j").read_text()  # the traceback


def test_the_run_of_a_killed_process_is_repeated(tmp_path: Path) -> None:
    found = program(
        tmp_path,
        f"""
import os, pathlib, signal
def run(run):
    mark = pathlib.Path({str(tmp_path)!r}, f"mark{{run.seed}}")
    if run.seed % 2 and not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return {{"square": run.seed ** 2}}
""",
    )
    rows = run_sweep(found, tasks_of(range(6), {}), LocalWorkers(found, 2), tmp_path / "j")
    assert [row["square"] for row in rows] == [0, 1, 4, 9, 16, 25]
    assert len(list(tmp_path.glob("mark*"))) == 3


def test_a_run_that_always_kills_its_process_is_given_up(tmp_path: Path) -> None:
    found = program(
        tmp_path, "import os\ndef run(run):\n    if run.seed == 1:\n        os.abort()\n    return {'ok': True}\n"
    )
    rows = run_sweep(found, tasks_of(range(3), {}), LocalWorkers(found, 2), tmp_path / "j")
    assert [row["ok"] for row in rows] == [True, None, True]
    assert rows[1]["error"] == "the process of the run was ended by SIGABRT, 3 times"


SLOW = """
import time
def run(run):
    time.sleep(0.05)
    with open({log!r}, "a") as log:
        log.write(f"{{run.seed}}\\n")
    return {{"cube": run.seed ** 3}}
"""
DRIVER = """
import sys
from pathlib import Path
from bubblesim.sweeps.local_workers import LocalWorkers
from bubblesim.sweeps.programs import FileProgram
from bubblesim.sweeps.sweep import run_sweep
from bubblesim.sweeps.tasks import tasks_of
program = FileProgram.read(Path(sys.argv[1]))
run_sweep(program, tasks_of(range(60), {}), LocalWorkers(program, 2), Path(sys.argv[2]))
"""
HELD = """
import os, pathlib, time
def run(run):
    folder = pathlib.Path({folder!r})
    if run.seed >= 20 and not (folder / "go_on").exists():
        (folder / f"held{{run.seed}}").write_text(str(os.getpid()))
        time.sleep(60.0)
    with (folder / "log").open("a") as log:
        log.write(f"{{run.seed}}\\n")
    return {{"cube": run.seed ** 3}}
"""


def runs(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/cmdline").read_bytes() != b""  # that of a zombie is empty
    except OSError:
        return False


def test_a_killed_driver_continues_and_its_workers_end(tmp_path: Path) -> None:
    log, journal = tmp_path / "log", tmp_path / "j"
    held = [tmp_path / "held20", tmp_path / "held21"]
    found = program(tmp_path, HELD.format(folder=str(tmp_path)))
    driver = subprocess.Popen([sys.executable, "-c", DRIVER, found.file, str(journal)])
    try:
        wait_until(lambda: all(mark.exists() and mark.read_text() for mark in held), "the runs in work", timeout=60.0)
        wait_until(lambda: journal.read_text().count("\n") == 1 + 20, "the finished runs in the journal")
        workers = [int(mark.read_text()) for mark in held]
        assert all(map(runs, workers))
    finally:
        driver.kill()
        driver.wait()
    wait_until(lambda: not any(map(runs, workers)), "the end of the workers, which end with the driver")
    with journal.open("ab") as stream:
        stream.write(b'{"seed": 59, "para')  # a line that was being written
    (tmp_path / "go_on").touch()
    rows = run_sweep(found, tasks_of(range(60), {}), LocalWorkers(found, 2), journal)
    assert [row["cube"] for row in rows] == [seed**3 for seed in range(60)]
    assert sorted(map(int, log.read_text().split())) == [*range(60)]  # no finished run was repeated


def test_more_seeds_use_what_the_journal_has(tmp_path: Path) -> None:
    log = tmp_path / "log"
    found = program(tmp_path, SLOW.format(log=str(log)))
    for count in (3, 5, 5):
        rows = run_sweep(found, tasks_of(range(count), {}), LocalWorkers(found, 2), tmp_path / "j")
        assert [row["cube"] for row in rows] == [seed**3 for seed in range(count)]
    assert sorted(map(int, log.read_text().split())) == [0, 1, 2, 3, 4]


def test_the_journal_of_another_program_is_refused(tmp_path: Path) -> None:
    journal = tmp_path / "j"
    first = program(tmp_path, "def run(run):\n    return {'a': 1}\n")
    run_sweep(first, tasks_of([0], {}), LocalWorkers(first, 1), journal)
    second = program(tmp_path, "def run(run):\n    return {'a': 2}\n")
    with pytest.raises(SweepError, match=r"before a change of the text of .*program.py.*--fresh"):
        run_sweep(second, tasks_of([0], {}), LocalWorkers(second, 1), journal)
    assert run_sweep(second, tasks_of([0], {}), LocalWorkers(second, 1), journal, fresh=True) == [{"seed": 0, "a": 2}]
    lines = journal.read_text().splitlines()
    journal.write_text("\n".join([lines[0], "{broken", lines[1], ""]))
    with pytest.raises(SweepError, match="j:2 cannot be read"):
        run_sweep(second, tasks_of([0], {}), LocalWorkers(second, 1), journal)
    journal.write_text("something else\n")
    with pytest.raises(SweepError, match="j:1 cannot be read"):
        run_sweep(second, tasks_of([0], {}), LocalWorkers(second, 1), journal)


def test_two_sweeps_do_not_write_one_journal(tmp_path: Path) -> None:
    found = program(tmp_path, "def run(run):\n    return {}\n")
    workers = LocalWorkers(found, 1)
    with pytest.raises(SweepError, match="in use by another sweep"):
        run_sweep(
            found,
            tasks_of([0], {}),
            workers,
            tmp_path / "j",
            on_progress=lambda *_: run_sweep(found, tasks_of([0], {}), workers, tmp_path / "j") and None,
        )


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("x = 1\n", "must define a function run"),
        ("import no_such_module\n", "program.py.*line 1(.|\n)*No module named 'no_such_module'"),
        ("def run(run:\n", "SyntaxError"),
    ],
)
def test_a_program_that_cannot_be_loaded_is_reported_once(tmp_path: Path, text: str, reason: str) -> None:
    found = program(tmp_path, text)
    with pytest.raises(SweepError, match=reason):
        run_sweep(found, tasks_of([0, 1], {}), LocalWorkers(found, 2), tmp_path / "j")


@pytest.mark.parametrize(
    ("returned", "reason"),
    [
        ("3", "must return a dict"),
        ("{'seed': 1}", "needs another name"),
        ("{'a': [1, 2]}", "must be a number, text, bool or None, found list"),
    ],
)
def test_results_of_other_types_are_errors(tmp_path: Path, returned: str, reason: str) -> None:
    found = program(tmp_path, f"def run(run):\n    return {returned}\n")
    (row,) = run_sweep(found, tasks_of([0], {}), LocalWorkers(found, 1), tmp_path / "j")
    assert reason in str(row["error"])


def test_numpy_scalars_are_results(tmp_path: Path) -> None:
    found = program(
        tmp_path, "import numpy as np\ndef run(run):\n    return {'a': np.float64(0.1), 'b': np.bool_(True)}\n"
    )
    (row,) = run_sweep(found, tasks_of([0], {}), LocalWorkers(found, 1), tmp_path / "j")
    assert (row["a"], row["b"], type(row["b"])) == (0.1, True, bool)
    assert json.loads((tmp_path / "j").read_text().splitlines()[1])["results"] == {"a": 0.1, "b": True}


def test_a_scene_measures_its_models(tmp_path: Path) -> None:
    found = SceneProgram("tricycle", duration=1.0)
    rows = run_sweep(found, tasks_of([3], SPEEDS), LocalWorkers(found, 1), tmp_path / "j")
    assert list(rows[0])[2:] == [f"/Tricycle.position.{axis}" for axis in "xyz"]
    slow, fast = (float(row["/Tricycle.position.x"] or 0.0) for row in rows)
    assert fast > slow > -2.5
    joint = SceneProgram("tricycle", 1.0, ("/FrontMotor.joint_velocity",))
    (row,) = run_sweep(
        joint, tasks_of([3], {"/FrontMotor.target_velocity": [1.0]}), LocalWorkers(joint, 1), tmp_path / "k"
    )
    assert row["/FrontMotor.joint_velocity"] == pytest.approx(1.0, abs=0.05)


@pytest.mark.parametrize(
    ("found", "parameters", "reason"),
    [
        (SceneProgram("no_such_scene", 1.0), {}, "no_such_scene"),
        (SceneProgram("tricycle", 1.0, ("/NoSuch.position",)), {}, "NoSuch"),
        (SceneProgram("tricycle", 1.0, ("/Tricycle.colour",)), {}, "no property 'colour'"),
        (SceneProgram("tricycle", 1.0, ("position",)), {}, "must be the path"),
    ],
)
def test_a_scene_that_cannot_be_measured_is_refused(
    tmp_path: Path, found: SceneProgram, parameters: dict[str, list[int | float | str]], reason: str
) -> None:
    with pytest.raises(ValueError, match=reason):
        run_sweep(found, tasks_of([0], parameters), LocalWorkers(found, 1), tmp_path / "j")


def test_a_parameter_that_is_no_property_is_an_error(tmp_path: Path) -> None:
    found = SceneProgram("tricycle", 1.0)
    rows = run_sweep(found, tasks_of([0], {"/Tricycle.path": [1]}), LocalWorkers(found, 1), tmp_path / "j")
    assert "no property 'path' that can be set" in str(rows[0]["error"])


def test_workers_run_with_one_thread_each_and_print_on_stderr(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    found = program(
        tmp_path, "import os\ndef run(run):\n    print('hello')\n    return {'t': os.environ['OMP_NUM_THREADS']}\n"
    )
    (row,) = run_sweep(found, tasks_of([0], {}), LocalWorkers(found, 1), tmp_path / "j")
    captured = capfd.readouterr()
    assert (row["t"], captured.out) == ("1", "")
    assert os.environ.get("OMP_NUM_THREADS") != "1" or row["t"] == "1"
