# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim sweep."""

import importlib.util
import signal
import subprocess
import time
from pathlib import Path

import pytest

from cli_support import bubblesim
from node_support import write
from ros_support import built

PROGRAM = "def run(run):\n    return {'product': run.seed * run.parameters['gain'], 'word': 'a'}\n"


def test_a_program_is_swept_into_a_table_a_file_and_a_plot(tmp_path: Path) -> None:
    write(tmp_path / "mine.py", PROGRAM)
    arguments = ["sweep", "mine.py", "--seeds", "1:3", "--set", "gain=1:2:0.5", "--workers", 2, "--plot", "plot.png"]
    run = bubblesim(*arguments, cwd=tmp_path)
    assert (run.returncode, [line.split() for line in run.stdout.splitlines()[:2]]) == (
        0,
        [["gain", "runs", "product"], ["1.0", "2", "1.5", "±", "0.71"]],
    ), run.stderr
    results = (tmp_path / "mine-sweep.csv").read_text().splitlines()
    assert results[:2] == ["seed,gain,product,word", "1,1.0,1.0,a"]
    assert len(results) == 1 + 6
    assert (tmp_path / "plot.png").read_bytes().startswith(b"\x89PNG")


def test_a_scene_is_swept(tmp_path: Path) -> None:
    speeds = "/FrontMotor.target_velocity=0.5,1"
    run = bubblesim("sweep", "tricycle", "--set", speeds, "--duration", 1, "--workers", 1, cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    assert "/Tricycle.position.x" in run.stdout
    assert len((tmp_path / "tricycle-sweep.csv").read_text().splitlines()) == 3


def test_failed_runs_give_exit_code_1(tmp_path: Path) -> None:
    write(tmp_path / "mine.py", "def run(run):\n    return {'a': 1 / run.seed}\n")
    run = bubblesim("sweep", "mine.py", "--seeds", "0:2", cwd=tmp_path)
    assert run.returncode == 1
    assert "1 of 2 runs failed, the first one: ZeroDivisionError: division by zero" in run.stderr


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (["none.py"], "cannot read none.py"),
        (["mine.py", "--seeds", "x"], "seeds are FIRST:END"),
        (["mine.py", "--set", "gain"], "NAME=FIRST:LAST:STEP"),
        (["mine.py", "--set", "a=1", "--set", "a=2"], "given twice"),
        (["mine.py", "--workers", "many"], "--workers is 'local'"),
        (["mine.py", "--output", "a.txt"], ".csv or .parquet"),
        (["mine.py", "--duration", "3"], "are for scenes"),
        (["tricycle", "--duration", "-3"], "must be above 0"),
        (["no_such_scene"], "no_such_scene"),
        (["tricycle", "--set", "/Tricycel.mass=1"], "/Tricycel.mass: no object matches '/Tricycel'; did you mean /Tri"),
        (["tricycle", "--set", "/Tricycle.positon=1"], "that can be set; did you mean position?"),
        (["tricycle", "--measure", "/Tricycle.positon"], "no property 'positon'; did you mean position?"),
        (["mine.py", "--set", "/Tricycle.positon=1"], "that can be set; did you mean position?"),
    ],
)
def test_bad_input_gives_exit_code_2(tmp_path: Path, arguments: list[str], reason: str) -> None:
    write(tmp_path / "mine.py", PROGRAM)
    run = bubblesim("sweep", *arguments, cwd=tmp_path)
    assert run.returncode == 2
    assert reason in run.stderr
    assert run.stdout == "", "no run has begun"


@pytest.mark.skipif(importlib.util.find_spec("ray") is not None, reason="Ray is installed")
def test_ray_that_is_not_installed_is_named(tmp_path: Path) -> None:
    write(tmp_path / "mine.py", PROGRAM)
    run = bubblesim("sweep", "mine.py", "--workers", "ray", cwd=tmp_path)
    assert (run.returncode, "pip install 'ray==2.60.*'" in run.stderr) == (2, True)


def test_ctrl_c_keeps_the_finished_runs(tmp_path: Path) -> None:
    write(tmp_path / "mine.py", "import time\ndef run(run):\n    time.sleep(0.05)\n    return {'a': run.seed}\n")
    command = [built("bubblesim"), "sweep", "mine.py", "--seeds", "0:2000", "--workers", "1"]
    sweep = subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.PIPE, text=True)
    journal = tmp_path / "mine-sweep.csv.journal"
    deadline = time.monotonic() + 60
    while not journal.exists() or journal.read_text().count("\n") < 4:
        assert time.monotonic() < deadline
        time.sleep(0.02)
    sweep.send_signal(signal.SIGINT)
    _, errors = sweep.communicate(timeout=30)
    assert sweep.returncode == 130
    assert "the same command continues" in errors
    finished = journal.read_text().count("\n") - 1
    again = bubblesim("sweep", "mine.py", "--seeds", f"0:{finished}", cwd=tmp_path)
    assert again.returncode == 0
    assert journal.read_text().count("\n") == 1 + finished  # nothing was repeated
