# SPDX-License-Identifier: BSD-3-Clause
"""Each experiment in bubblesim is within its tolerance of the theory."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from experiments.experiment import Experiment, run
from experiments.ours import Ode, Ours
from experiments.registry import EXPERIMENTS
from experiments.table import outcome_text
from ros_support import REPOSITORY

PROGRAM = REPOSITORY / "scripts" / "conformance"


@pytest.mark.parametrize("engine", [Ours, Ode], ids=lambda engine: engine.name)
@pytest.mark.parametrize(
    "experiment", [pytest.param(e, id=e.name, marks=pytest.mark.long if e.long else ()) for e in EXPERIMENTS]
)
def test_physics_agree_with_theory(experiment: Experiment, engine: type[Ours]) -> None:
    if engine is Ode and not experiment.ode:
        pytest.skip("ODE's solver does not agree")
    result = run(experiment, engine)
    wrong = [outcome_text(outcome) for outcome in result.outcomes if not outcome.holds]
    assert not wrong, "\n".join([f"{experiment.title} ({experiment.unit}); {experiment.theory.__doc__}", *wrong])


def test_names_are_unique_and_theories_have_a_source() -> None:
    names = [experiment.name for experiment in EXPERIMENTS]
    assert sorted(set(names)) == sorted(names)
    assert [e.name for e in EXPERIMENTS if not (e.theory.__doc__ and e.tolerance.why)] == []


def test_program_writes_its_results(tmp_path: Path) -> None:
    files = ["--json", str(tmp_path / "results.json"), "--markdown", str(tmp_path / "table.md")]
    command = [sys.executable, str(PROGRAM), "--only", "push", *files]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert "1 of 1 experiments within their tolerance" in done.stdout
    cases = json.loads((tmp_path / "results.json").read_text())["push"]["bubblesim"]["cases"]
    assert [case["theory"] for case in cases] == [120, 4, 0.012]
    assert (tmp_path / "table.md").read_text().count("\n") == 3


def test_program_names_unknown_experiments() -> None:
    command = [sys.executable, str(PROGRAM), "--only", "perpetuum"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 2
    assert "no experiment is named 'perpetuum'" in done.stderr
