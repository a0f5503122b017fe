# SPDX-License-Identifier: BSD-3-Clause
"""Scripts cannot end, replace or fork the simulator with functions of os."""

from pathlib import Path

import pytest

from node_support import run_script


@pytest.mark.parametrize(
    ("call", "name"),
    [
        ("os.fork()", "os.fork"),
        ("os.forkpty()", "os.forkpty"),
        ("os.spawnlp(os.P_WAIT, 'true', 'true')", "os.fork"),
        ("os._exit(0)", "os._exit"),
        ("os.abort()", "os.abort"),
        ("os.execlp('true', 'true')", "os.exec"),
        ("multiprocessing.Process(target=print).start()", "os.fork"),
    ],
)
@pytest.mark.parametrize("hook", ["sysCall_init", "sysCall_actuation"])
def test_a_call_that_would_is_named_with_its_place_and_the_run_goes_on(
    tmp_path: Path, call: str, name: str, hook: str
) -> None:
    code = f"""\
        import multiprocessing, os
        def sysCall_init(): pass
        def {hook}():
            {call}
    """
    run = run_script(tmp_path, code, "--state-hash")
    assert run.returncode == 3
    assert f"failed in {hook} (" in run.stderr
    assert f'{tmp_path}/script.py", line 4, in {hook}' in run.stderr
    assert f"ForbiddenCallError: {name}" in run.stderr
    assert len(run.stdout.splitlines()) == 1, "one simulator prints one hash"


def test_a_fork_by_other_means_makes_no_second_simulator(tmp_path: Path) -> None:
    code = """
        import ctypes
        def sysCall_init(): ctypes.PyDLL(None).fork()
        def sysCall_sensing(): print('sensing')
    """
    run = run_script(tmp_path, code, "--state-hash", until=0.1)
    assert run.returncode == 0
    assert run.stdout.count("sensing") == 2
    assert len(run.stdout.splitlines()) == 3


def test_programs_are_started_as_ever(tmp_path: Path) -> None:
    code = """
        import os, subprocess
        def sysCall_init():
            print(subprocess.check_output(['echo', 'one'], text=True).strip())
            print(subprocess.check_output(['echo', 'two'], preexec_fn=lambda: None, text=True).strip())
            print(os.popen('echo three').read().strip(), os.system('true'))
    """
    run = run_script(tmp_path, code)
    assert (run.returncode, run.stdout) == (0, "one\ntwo\nthree 0\n"), run.stderr
