# SPDX-License-Identifier: BSD-3-Clause
"""A script that fails is reported once, with file:line and object, and the other scripts continue."""

import re
from pathlib import Path

import pytest

from node_support import run_script, run_sim, write

FAILURES = {
    "loading": "x = 1 / 0\ndef sysCall_init(): pass\n",
    "sysCall_init": "def sysCall_init(): 1 / 0\n",
    "sysCall_actuation": "def sysCall_init(): pass\ndef sysCall_actuation(): 1 / 0\n",
    "sysCall_sensing": "def sysCall_init(): pass\ndef sysCall_sensing(): 1 / 0\n",
    "sysCall_cleanup": "def sysCall_init(): pass\ndef sysCall_cleanup(): 1 / 0\n",
}


@pytest.mark.parametrize("phase", FAILURES)
def test_traceback_is_printed_once_with_place_and_object(tmp_path: Path, phase: str) -> None:
    code = FAILURES[phase]
    run = run_script(tmp_path, code)
    line = code[: code.index("1 / 0")].count("\n") + 1
    place = f"{tmp_path}/script.py:{line}"
    first, *traceback = run.stderr.splitlines()
    assert first == f"error: child script of /Ball failed in {phase} ({place}) and is disabled:"
    assert traceback[0] == "Traceback (most recent call last):"
    assert traceback[-1] == "ZeroDivisionError: division by zero"
    assert run.stderr.count("ZeroDivisionError") == 1
    assert "bubblesim/scripting" not in run.stderr


@pytest.mark.parametrize("options", [[], ["--strict"]], ids=["", "strict"])
@pytest.mark.parametrize("phase", FAILURES)
def test_a_run_whose_script_failed_exits_with_3(tmp_path: Path, phase: str, options: list[str]) -> None:
    assert run_script(tmp_path, FAILURES[phase], *options).returncode == 3


def test_without_strict_the_run_goes_on_to_its_end(tmp_path: Path) -> None:
    code = "def sysCall_init(): 1 / 0\n"
    other = "def sysCall_init(): pass\ndef sysCall_cleanup(): print(round(sim.getSimulationTime(), 3))\n"
    beside = ["--child-script", f"/Floor={write(tmp_path / 'other.py', other)}"]
    run = run_script(tmp_path, code, *beside, until=1.0)
    assert (run.returncode, run.stdout) == (3, "1.0\n"), run.stderr


def test_strict_ends_as_soon_as_a_script_failed(tmp_path: Path) -> None:
    code = "def sysCall_init(): print('init')\ndef sysCall_sensing():\n    print('sensing')\n    1 / 0\n"
    assert run_script(tmp_path, code, "--strict", until=1e6).stdout == "init\nsensing\n"


def test_a_syntax_error_names_file_line_and_text(tmp_path: Path) -> None:
    run = run_script(tmp_path, "def sysCall_init():\n    pass\ndef broken(:\n", "--strict")
    assert run.returncode == 3
    assert run.stderr.startswith(
        f"error: child script of /Ball is disabled: {tmp_path}/script.py:3: SyntaxError: invalid syntax"
    )
    assert "def broken(:" in run.stderr


def test_a_script_needs_an_init_or_a_thread(tmp_path: Path) -> None:
    run = run_script(tmp_path, "def sysCall_actuation(): pass\n", "--strict")
    assert run.returncode == 3
    assert f"{tmp_path}/script.py: it defines neither sysCall_init nor sysCall_thread; a script needs one" in run.stderr


def test_a_missing_include_names_its_line_and_the_cure(tmp_path: Path) -> None:
    run = run_script(tmp_path, "#python\ninclude nothing\ndef sysCall_init(): pass\n", "--strict")
    assert run.returncode == 3
    assert f"{tmp_path}/script.py:2: file not found: nothing.py in {tmp_path}" in run.stderr
    assert "--script-path" in run.stderr


def test_scripts_that_include_each_other_are_refused(tmp_path: Path) -> None:
    write(tmp_path / "other.py", "include script\n")
    run = run_script(tmp_path, "include other\ndef sysCall_init(): pass\n", "--strict")
    assert run.returncode == 3
    assert "includes itself" in run.stderr


def test_a_file_of_other_bytes_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "script.py"
    file.write_bytes(b"x = '\xff'\n")
    run = run_sim("ball", "--no-ros", "--until", 0.05, "--strict", "--child-script", f"/Ball={file}")
    assert run.returncode == 3
    assert f"{file}: cannot be read" in run.stderr


def test_an_error_of_an_api_call_points_to_the_scripts_line(tmp_path: Path) -> None:
    run = run_script(tmp_path, "def sysCall_init():\n    sim.getObject('/Bal')\n")
    assert "script.py:2) and is disabled" in run.stderr
    assert "NoSuchObject: no object matches '/Bal'" in run.stderr
    assert "did you mean /Ball?" in run.stderr
    assert "bubblesim/scripting" not in run.stderr


def test_causes_of_an_error_are_shown(tmp_path: Path) -> None:
    code = """
        def sysCall_init():
            try:
                int('ten')
            except ValueError as error:
                raise RuntimeError('no number of wheels') from error
    """
    run = run_script(tmp_path, code)
    assert "int() with base 10: 'ten'" in run.stderr
    assert run.stderr.endswith("RuntimeError: no number of wheels\n")


def test_other_scripts_and_the_simulation_run_on(tmp_path: Path) -> None:
    bad = write(tmp_path / "bad.py", "def sysCall_init(): 1 / 0\n")
    good = "def sysCall_init(): pass\ndef sysCall_cleanup(): print(f'{sim.getSimulationTime():.2f}')\n"
    run = run_script(tmp_path, good, "--child-script", f"/Ramp={bad}")
    assert "child script of /Ramp failed" in run.stderr
    assert run.stdout == "0.20\n"


def test_a_failed_script_is_not_called_again(tmp_path: Path) -> None:
    code = """
        def sysCall_init(): pass
        def sysCall_actuation():
            print('actuation')
            1 / 0
        def sysCall_sensing(): print('sensing')
        def sysCall_cleanup(): print('cleanup')
    """
    assert run_script(tmp_path, code).stdout == "actuation\n"


def test_exit_ends_only_the_script_and_is_no_failure(tmp_path: Path) -> None:
    leaving = write(tmp_path / "leaving.py", "import sys\ndef sysCall_init(): sys.exit(5)\n")
    good = "def sysCall_init(): pass\ndef sysCall_cleanup(): print('ran on')\n"
    run = run_script(tmp_path, good, "--strict", "--child-script", f"/Ramp={leaving}")
    assert (run.stdout, run.stderr, run.returncode) == ("ran on\n", "", 0)


@pytest.mark.parametrize(
    ("name", "code", "reported"),
    [
        ("bad.py", "def deep(): return deep()\ndef sysCall_init(): deep()\n", "RecursionError"),
        ("bad.py", "def sysCall_init(): bytes(1 << 62)\n", "MemoryError"),
        ("bad.lua", "function deep() return 1 + deep() end\nfunction sysCall_init() deep() end\n", "stack overflow"),
        ("bad.lua", "function sysCall_init() string.rep('x', (1 << 31) - 1) end\n", "not enough memory"),
    ],
)
def test_what_exhausts_the_machine_ends_only_the_script(tmp_path: Path, name: str, code: str, reported: str) -> None:
    bad = write(tmp_path / name, code)
    good = "def sysCall_init(): pass\ndef sysCall_cleanup(): print('ran on')\n"
    run = run_script(tmp_path, good, "--child-script", f"/Ramp={bad}")
    assert (run.stdout, run.returncode) == ("ran on\n", 3)
    assert "child script of /Ramp failed in sysCall_init" in run.stderr
    assert reported in run.stderr
    assert len(run.stderr) < 5000


def test_a_raised_keyboard_interrupt_ends_only_the_script(tmp_path: Path) -> None:
    run = run_script(tmp_path, "def sysCall_init(): raise KeyboardInterrupt\n")
    assert "child script of /Ball failed in sysCall_init" in run.stderr
    assert run.returncode == 3


def test_a_thread_that_never_ends_does_not_keep_the_node(tmp_path: Path) -> None:
    code = """
        import threading
        def sysCall_init(): threading.Thread(target=threading.Event().wait, name='waits').start()
        def sysCall_cleanup(): print('cleanup')
    """
    run = run_script(tmp_path, code)
    assert (run.stdout, run.returncode) == ("cleanup\n", 0)
    assert run.stderr == "warning: threads of scripts did not end: waits\n"


def test_an_attribute_of_self_that_is_not_set_is_named_with_the_nearest_one(tmp_path: Path) -> None:
    code = "def sysCall_init(): self.ball = 1\ndef sysCall_actuation(): print(self.bal)\n"
    lines = run_script(tmp_path, code).stderr.splitlines()
    assert lines[0].startswith(f"error: child script of /Ball failed in sysCall_actuation ({tmp_path}/script.py:2)")
    assert lines[-1] == "AttributeError: self.bal is not set in this script; did you mean self.ball?"
    asks = "def sysCall_init(): print(hasattr(self, 'b'), getattr(self, 'b', 5))\n"
    assert run_script(tmp_path, asks).stdout == "False 5\n"


def test_a_function_written_like_a_method_is_reported_with_its_line_and_the_cure(tmp_path: Path) -> None:
    first, *traceback = run_script(tmp_path, "import math\ndef sysCall_init(self): pass\n").stderr.splitlines()
    assert first == f"error: child script of /Ball failed in sysCall_init ({tmp_path}/script.py:2) and is disabled:"
    (reason,) = traceback
    assert reason.endswith("'self'; `self` is a global of the script: write def sysCall_init():")


def test_a_module_that_is_not_installed_is_named_with_the_python_that_needs_it(tmp_path: Path) -> None:
    run = run_script(tmp_path, "import nowhere.parts\ndef sysCall_init(): pass\n")
    assert f"failed in loading ({tmp_path}/script.py:1)" in run.stderr
    reason = run.stderr.splitlines()[-1]
    assert re.fullmatch(
        r"ModuleNotFoundError: No module .*; scripts run with Python 3.\d+ of /.*: install nowhere .*", reason
    )


def test_modules_of_the_simulator_need_no_import(tmp_path: Path) -> None:
    run = run_script(tmp_path, "import simROS\ndef sysCall_init(): pass\n")
    reason = run.stderr.splitlines()[-1]
    assert reason.endswith("; simROS is there without an import: remove the line, or write simROS = require('simROS')")


def test_a_module_beside_the_script_is_to_be_included(tmp_path: Path) -> None:
    write(tmp_path / "helper.py", "speed = 2\n")
    reason = run_script(tmp_path, "import helper\ndef sysCall_init(): pass\n").stderr.splitlines()[-1]
    assert f"modules are not searched in {tmp_path}: begin the script with the line `include helper`" in reason
    run = run_script(tmp_path, "include helper\ndef sysCall_init(): print(speed)\n")
    assert (run.stdout, run.stderr) == ("2\n", "")


def test_a_script_in_another_language_is_named(tmp_path: Path) -> None:
    run = run_script(tmp_path, "function sysCall_init() {}\n", name="drive.js")
    assert run.returncode == 3
    assert "drive.js:1: JavaScript does not run here: scripts are written in Python (.py) or Lua (.lua)" in run.stderr
    assert run_script(tmp_path, "#python\ndef sysCall_init(): print('runs')\n", name="drive.js").stdout == "runs\n"
