# SPDX-License-Identifier: BSD-3-Clause
"""The program bubblesim: features common to all commands."""

import os
import pty
import shutil
import subprocess
from pathlib import Path

import pytest

from bubblesim import __version__
from cli_support import bubblesim
from ros_support import built

COMMANDS = ["demo", "run", "ps", "shell", "scenes", "new-scene", "describe", "convert", "api", "test", "doctor"]


def test_help_names_all_commands_and_exit_codes() -> None:
    run = bubblesim("--help")
    assert run.returncode == 0
    assert all(f"\n    {command}" in run.stdout for command in COMMANDS)
    assert "exit codes: 0 success, 1" in run.stdout


def test_it_has_the_version_of_the_node() -> None:
    node = subprocess.run([built("sim"), "--version"], capture_output=True, text=True, check=True)
    assert bubblesim("--version").stdout == node.stdout == f"bubblesim {__version__}\n"


@pytest.mark.parametrize("command", COMMANDS)
def test_each_command_explains_itself(command: str) -> None:
    run = bubblesim(command, "--help")
    assert (run.returncode, run.stderr) == (0, "")
    assert f"usage: bubblesim {command}" in run.stdout


@pytest.mark.parametrize(
    "arguments",
    [[], ["bogus"], ["scenes", "--bogus"], ["scenes", "bogus"], ["api", "a", "b"], ["new-scene"], ["run"], ["test"]],
)
def test_bad_usage_is_explained_with_exit_code_2(arguments: list[str]) -> None:
    run = bubblesim(*arguments)
    assert run.returncode == 2
    assert run.stdout == ""
    assert "usage: bubblesim" in run.stderr


def test_it_is_on_the_path_of_a_sourced_workspace() -> None:
    assert shutil.which("bubblesim") is not None


def test_a_reader_that_has_seen_enough_is_no_error() -> None:
    run = subprocess.run(
        ["bash", "-c", f"{built('bubblesim')} api | true"], capture_output=True, text=True, check=False
    )
    assert run.stderr == ""


def test_colours_are_for_terminals_only() -> None:
    assert "\033[" not in bubblesim("api", "sim.getObject").stdout
    assert "\033[1m" in on_a_terminal({})
    assert "\033[" not in on_a_terminal({"NO_COLOR": "1"})


def on_a_terminal(changes: dict[str, str]) -> str:
    """Return what `bubblesim api sim.getObject` writes to a terminal."""
    ours, its = pty.openpty()
    environment = {**os.environ, "TERM": "xterm", **changes}
    subprocess.run([built("bubblesim"), "api", "sim.getObject"], env=environment, stdout=its, check=True)
    os.close(its)
    with os.fdopen(ours, "rb") as terminal:
        return terminal.read1().decode()


def test_a_build_that_cannot_be_loaded_is_reported_with_the_cure(tmp_path: Path) -> None:
    (tmp_path / "bubblesim").mkdir()
    (tmp_path / "bubblesim" / "__init__.py").write_text("import no_such_module\n")
    run = bubblesim("scenes", PYTHONPATH=str(tmp_path))
    assert run.returncode == 2
    assert "No module named 'no_such_module'" in run.stderr
    assert "fix: " in run.stderr
    assert "Traceback" not in run.stderr


def test_a_command_with_a_typo_is_answered_with_the_nearest_one() -> None:
    run = bubblesim("rnu", "ball")
    assert run.returncode == 2
    assert "there is no command 'rnu'; did you mean run?" in run.stderr


@pytest.mark.parametrize(
    ("word", "answer"),
    [
        ("--verison", "there is no option '--verison'; did you mean --version?"),
        ("--scene", "there is no option '--scene'; options follow a command: bubblesim COMMAND [option ...]"),
        ("help", "there is no command 'help'; did you mean `bubblesim --help`?"),
        ("add_message", "there is no command 'add_message'; did you mean `rosrun bubblesim add_message`?"),
    ],
)
def test_words_that_are_no_commands_lead_to_what_was_meant(word: str, answer: str) -> None:
    run = bubblesim(word)
    assert (run.returncode, run.stderr.splitlines()[-1]) == (2, f"bubblesim: error: {answer}")
