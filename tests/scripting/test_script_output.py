# SPDX-License-Identifier: BSD-3-Clause
"""Printed lines of scripts start with the object and the simulation time."""

import subprocess
from pathlib import Path

import pytest

from node_support import run_script, without_slowness, write
from ros_support import built


def output(folder: Path, code: str, *arguments: object, name: str = "script.py") -> tuple[str, str]:
    run = run_script(folder, code, *arguments, name=name, until=0.1, prefixed=True)
    assert run.returncode == (3 if "is disabled" in run.stderr else 0)
    return run.stdout, run.stderr


def test_lines_begin_with_object_and_time(tmp_path: Path) -> None:
    code = "def sysCall_init(): print('one', 2)\ndef sysCall_sensing(): print('three')\n"
    expected = "[/Ball 0.000 s] one 2\n[/Ball 0.000 s] three\n[/Ball 0.050 s] three\n"
    assert output(tmp_path, code) == (expected, "")


def test_lines_of_lua_do_too(tmp_path: Path) -> None:
    code = "function sysCall_init() print('one', 2) end\nfunction sysCall_cleanup() print('a\\nb') end\n"
    expected = "[/Ball 0.000 s] one\t2\n[/Ball 0.100 s] a\n[/Ball 0.100 s] b\n"
    assert output(tmp_path, code, name="script.lua") == (expected, "")


def test_standard_error_does_too(tmp_path: Path) -> None:
    code = "import sys\ndef sysCall_init(): print('oh', file=sys.stderr)\n"
    assert output(tmp_path, code) == ("", "[/Ball 0.000 s] oh\n")


@pytest.mark.parametrize("statement", ["print('a\\nb')", "print('a', 'b', sep='\\n')", "print('a'); print('b')"])
def test_each_of_several_lines_does(tmp_path: Path, statement: str) -> None:
    assert output(tmp_path, f"def sysCall_init(): {statement}\n")[0] == "[/Ball 0.000 s] a\n[/Ball 0.000 s] b\n"


def test_a_line_may_come_in_pieces(tmp_path: Path) -> None:
    code = """
        import sys
        def sysCall_init():
            print('a', end='')
            print('b', end=' ', flush=True)
            sys.stdout.write('c')
            sys.stdout.writelines([' d', '\\n'])
    """
    assert output(tmp_path, code)[0] == "[/Ball 0.000 s] ab c d\n"


def test_an_unfinished_line_ends_where_another_script_begins(tmp_path: Path) -> None:
    other = write(tmp_path / "other.py", "def sysCall_init(): print('other')\n")
    text, _ = output(tmp_path, "def sysCall_init(): print('a', end='')\n", "--child-script", f"/Ramp={other}")
    assert sorted(text.splitlines()) == ["[/Ball 0.000 s] a", "[/Ramp 0.000 s] other"]


def test_threads_and_modules_of_a_script_print_as_it(tmp_path: Path) -> None:
    write(tmp_path / "helper.py", "def report(): print('helper')\n")
    code = f"""
        import sys, threading
        sys.path.insert(0, {str(tmp_path)!r})
        import helper
        def in_thread(): print('thread')
        def sysCall_init():
            helper.report()
            thread = threading.Thread(target=in_thread)
            thread.start()
            thread.join()
        def sysCall_thread(): print('own thread')
    """
    expected = ["helper", "thread", "own thread"]
    assert output(tmp_path, code)[0].splitlines() == [f"[/Ball 0.000 s] {line}" for line in expected]


def test_lines_of_the_simulator_stay_as_they_are(tmp_path: Path) -> None:
    code = "def sysCall_init(): sim.addLog(sim.verbosity_scriptinfos, 'text')\ndef sysCall_sensing(): 1 / 0\n"
    out, error = output(tmp_path, code)
    assert out == "info: /Ball: text\n"
    assert error.startswith("error: child script of /Ball failed in sysCall_sensing")
    assert "[/Ball" not in error


def test_what_cannot_be_encoded_is_no_failure(tmp_path: Path) -> None:
    assert output(tmp_path, "def sysCall_init(): print('\\udcff')\n") == ("[/Ball 0.000 s] \\udcff\n", "")


def test_a_reader_that_has_gone_is_no_failure(tmp_path: Path) -> None:
    script = write(tmp_path / "script.py", "def sysCall_init(): pass\ndef sysCall_sensing(): print('x' * 100000)\n")
    options = ["--no-ros", "--speed", "max", "--until", 1, "--strict", "--child-script", f"/Ball={script}"]
    command = [
        "bash",
        "-c",
        '"$@" | true; exit ${PIPESTATUS[0]}',
        "bash",
        str(built("sim")),
        "ball",
        *map(str, options),
    ]
    run = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert (run.returncode, without_slowness(run.stderr)) == (0, "")
