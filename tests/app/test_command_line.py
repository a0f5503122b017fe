# SPDX-License-Identifier: BSD-3-Clause
"""The node's command line: accepted and rejected arguments, and exit codes."""

import os
import re
import subprocess
from pathlib import Path

import pytest

from node_support import (
    PREFIX,
    clean_environment,
    endless_fall,
    processes_with,
    run_script,
    run_sim,
    without_slowness,
    write,
)
from ros_support import REPOSITORY, built

COUNT = "def sysCall_init(): self.n = 0\ndef sysCall_actuation(): self.n += 1\ndef sysCall_cleanup(): print(self.n)\n"


def test_help_names_every_option_and_exit_code() -> None:
    run = run_sim("--help")
    assert run.returncode == 0
    options = {"seed", "until", "speed", "paused", "no-ros", "child-script", "script-path", "strict", "state-hash"}
    for option in options | {"list-scenes", "version"}:
        assert f"--{option}" in run.stdout
    assert "4 the physics diverged" in run.stdout


def test_version_is_that_of_the_package() -> None:
    wanted = re.search(r"<version>(.*)</version>", (REPOSITORY / "package.xml").read_text())
    assert wanted is not None
    assert run_sim("--version").stdout == f"bubblesim {wanted[1]}\n"


def test_scenes_are_listed() -> None:
    run = run_sim("--list-scenes")
    assert run.returncode == 0
    assert {"ball", "bubblerob", "tricycle"} <= set(run.stdout.split())


@pytest.mark.parametrize(
    ("arguments", "reported"),
    [
        ([], "SCENE"),
        (["ball", "--bogus"], "error: unknown option --bogus\n"),
        (
            ["ball", "--childscript", "/Ball=x.py"],
            "unknown option --childscript; did you mean --child-script?\nRun with",
        ),
        (["ball", "--childscript=/Ball=x.py"], "unknown option --childscript; did you mean --child-script?\nRun with"),
        (["ball", "other"], "unexpected argument 'other'"),
        (["ball", "--seed", "-3"], "--seed: expected a whole number from 0 to 18446744073709551615, found '-3'"),
        (["ball", "--seed", "x"], "--seed: expected a whole number"),
        (["ball", "--until", "soon"], "--until"),
        (["ball", "--until", "-1"], "--until"),
        (["ball", "--until", "nan"], "--until"),
        (["ball", "--seed", "x"], "--seed"),
        (["ball", "--speed", "fast"], "expected a number above 0 or 'max', found 'fast'"),
        (["ball", "--speed", "0"], "expected a number above 0 or 'max', found '0'"),
        (["ball", "--speed", "nan"], "expected a number above 0 or 'max', found 'nan'"),
        (["ball", "--child-script", "x.py"], "expected OBJECT=FILE such as /Tricycle=my.py, found 'x.py'"),
        (["ball", "--no-ros", "--child-script", "/Ball=/none.py"], "file not found: /none.py (child script of /Ball)"),
        (["ball", "--no-ros", "--child-script", "/Bal=/etc/hostname"], "did you mean /Ball?"),
        (["nosuch", "--no-ros"], "scene not found: 'nosuch'"),
        (["tricycel", "--no-ros"], "tricycle"),
        (["/none/such.sdf", "--no-ros"], "/none/such.sdf"),
        (["dd.py", "--no-ros"], "dd.py: is a script, not a scene: give the .sdf file"),
        (["my/robot.lua", "--no-ros"], "my/robot.lua: is a script, not a scene: give the .sdf file"),
        (["bubbleRob.ttt", "--no-ros"], "bubbleRob.ttt: file not found"),
        (["a/room.simscene.xml", "--no-ros"], "a/room.simscene.xml: is a CoppeliaSim file"),
    ],
    ids=" ".join,
)
def test_bad_input_is_explained_with_exit_code_2(arguments: list[str], reported: str) -> None:
    run = run_sim(*arguments)
    assert reported in run.stderr
    assert run.returncode == 2
    assert run.stdout == ""


def test_a_bad_scene_reports_all_its_problems(tmp_path: Path) -> None:
    text = (REPOSITORY / "scenes" / "ball.sdf").read_text()
    text = text.replace("<mass>0.5</mass>", "<mass>-1</mass>").replace("<radius>0.1</radius>", "<radius>0</radius>")
    scene = tmp_path / "bad.sdf"
    scene.write_text(text.replace(">ball.py<", ">nothing.py<"))
    run = run_sim(scene, "--no-ros")
    assert run.returncode == 2
    assert len(re.findall(rf"^(?:error: )?.*{re.escape(str(scene))}(?::\d+)?: /Ball", run.stderr, re.MULTILINE)) == 3, (
        run.stderr
    )


@pytest.mark.parametrize(("until", "steps"), [(0, 0), (0.01, 1), (0.05, 1), (0.1, 2), (0.12, 3), (1, 20), (3.3, 66)])
def test_until_runs_the_steps_that_begin_before_it(tmp_path: Path, until: float, steps: int) -> None:
    expected = f"{steps}\n" if steps else ""
    assert run_script(tmp_path, COUNT, until=until).stdout == expected


def test_a_paced_run_does_what_a_fast_one_does(tmp_path: Path) -> None:
    file = write(tmp_path / "script.py", COUNT)
    options = ["ball", "--no-ros", "--until", 0.5, "--state-hash", "--child-script", f"/Ball={file}"]
    fast, paced = (run_sim(*options, "--speed", speed) for speed in ("max", "2"))
    assert fast.stdout == paced.stdout
    assert fast.stdout.startswith("10\n")


def test_state_hash_is_equal_in_every_process_and_depends_on_what_happened() -> None:
    def state_hash(*options: object) -> str:
        return run_sim("tricycle", "--no-ros", "--speed", "max", "--state-hash", *options).stdout

    first = state_hash("--until", 1, "--seed", 5)
    assert re.fullmatch(r"[0-9a-f]{16}\n", first)
    assert state_hash("--until", 1, "--seed", 5) == first
    assert state_hash("--until", 1.05, "--seed", 5) != first


def test_a_saved_state_continues_as_if_the_run_had_not_ended(tmp_path: Path) -> None:
    code = """
        def sysCall_init(): pass
        def sysCall_actuation():
            sim.setJointTargetVelocity(sim.getObject('/FrontMotor'), sim.getSimulationTime())
    """
    script = write(tmp_path / "script.py", code)
    run = ["tricycle", "--no-ros", "--speed", "max", "--state-hash", "--child-script", f"/Tricycle={script}"]
    file = tmp_path / "state"
    whole = run_sim(*run, "--until", 2)
    first = run_sim(*run, "--until", 1, "--save-state", file)
    assert first.returncode == 0, first.stderr
    second = run_sim(*run, "--until", 2, "--load-state", file, "--seed", 4)
    assert second.stdout == whole.stdout
    file.write_bytes(file.read_bytes()[:-1])
    cut = run_sim(*run, "--until", 2, "--load-state", file)
    assert cut.returncode == 2
    assert f"{file}: the saved state is damaged" in cut.stderr


def test_diverging_physics_end_with_exit_code_4_and_cleanup(tmp_path: Path) -> None:
    code = """
        def sysCall_init(): sim.launchExecutable('sleep', '36057.5')
        def sysCall_cleanup(): print('cleanup')
    """
    run = run_script(tmp_path, code, scene=str(endless_fall(tmp_path)), until=30)
    assert run.returncode == 4
    assert "/Ball" in run.stderr
    assert run.stdout == "cleanup\n"
    assert processes_with("sleep 36057.5") == []


def test_runs_outside_of_any_workspace() -> None:
    run = run_sim("ball", "--no-ros", "--until", 0.1, env=clean_environment(PATH="/usr/bin:/bin"))
    assert (run.returncode, without_slowness(run.stderr)) == (0, "")


def test_runs_when_another_python_comes_first_on_the_path(tmp_path: Path) -> None:
    other = tmp_path / "python3"
    other.write_text("#!/bin/sh\nexit 9\n")
    other.chmod(0o755)
    code = "import sys\ndef sysCall_init(): print(sys.version_info[:2], sys.prefix)\n"
    file = write(tmp_path / "script.py", code)
    debians = subprocess.check_output(["/usr/bin/python3", "-c", "import sys; print(sys.version_info[:2])"], text=True)
    run = subprocess.run(
        [built("sim"), "ball", "--no-ros", "--until", "0.05", "--child-script", f"/Ball={file}"],
        env={**os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (PREFIX.sub("", run.stdout), without_slowness(run.stderr)) == (f"{debians.strip()} /usr\n", "")


def test_script_output_survives_a_plain_locale(tmp_path: Path) -> None:
    file = write(tmp_path / "script.py", "def sysCall_init(): sim.addLog(450, 'Zürich')\n")
    env = clean_environment(LC_ALL="C", PATH="/usr/bin:/bin")
    run = run_sim("ball", "--no-ros", "--until", 0.05, "--child-script", f"/Ball={file}", env=env)
    assert (run.returncode, without_slowness(run.stderr)) == (0, "")
    assert "rich" in run.stdout
