# SPDX-License-Identifier: BSD-3-Clause
"""When a script's callbacks are called, what they can access, and the forms of a script."""

from pathlib import Path

from node_support import run_script, run_sim, without_slowness, write


def lines(folder: Path, code: str, *arguments: object, until: float = 0.2) -> list[str]:
    run = run_script(folder, code, *arguments, until=until)
    assert run.stderr == ""
    assert run.returncode == 0
    return run.stdout.splitlines()


def test_callbacks_come_in_order_under_one_time_a_pass(tmp_path: Path) -> None:
    code = """
        def report(what): print(what, f'{sim.getSimulationTime():.3f}')
        def sysCall_init(): report('init')
        def sysCall_actuation(): report('actuation')
        def sysCall_sensing(): report('sensing')
        def sysCall_cleanup(): report('cleanup')
    """
    assert lines(tmp_path, code, until=0.1) == [
        "init 0.000",
        "actuation 0.000",
        "sensing 0.000",
        "actuation 0.050",
        "sensing 0.050",
        "cleanup 0.100",
    ]


def test_sensing_sees_what_the_dynamics_did(tmp_path: Path) -> None:
    code = """
        def height(): return sim.getObjectPosition(sim.getObject('.'))[2]
        def sysCall_init(): self.falls = 0
        def sysCall_actuation(): self.before = height()
        def sysCall_sensing(): self.falls += height() < self.before
        def sysCall_cleanup(): print(self.falls)
    """
    assert lines(tmp_path, code) == ["4"]


def test_actuation_moves_the_world_of_the_same_pass(tmp_path: Path) -> None:
    code = """
        def sysCall_init(): pass
        def sysCall_actuation(): sim.setObjectPosition(sim.handle_self, [7, 0, 5])
        def sysCall_sensing(): print(round(sim.getObjectPosition(sim.handle_self)[0], 6))
    """
    assert lines(tmp_path, code, until=0.05) == ["7.0"]


def test_self_and_globals_persist(tmp_path: Path) -> None:
    code = """
        count = 0
        def sysCall_init(): self.count = 0
        def sysCall_actuation():
            global count
            count += 1
            self.count += 1
        def sysCall_cleanup(): print(count, self.count)
    """
    assert lines(tmp_path, code) == ["4 4"]


def test_a_stop_request_gives_one_more_whole_pass(tmp_path: Path) -> None:
    code = """
        def report(what): print(what, f'{sim.getSimulationTime():.2f}', hex(sim.getSimulationState()))
        def sysCall_init(): pass
        def sysCall_actuation():
            report('actuation')
            sim.stopSimulation()
        def sysCall_sensing(): report('sensing')
        def sysCall_cleanup(): report('cleanup')
    """
    assert lines(tmp_path, code, until=10) == [
        "actuation 0.00 0x11",
        "sensing 0.00 0x11",
        "actuation 0.05 0x16",
        "sensing 0.05 0x16",
        "cleanup 0.10 0x16",
    ]


def test_require_gives_the_modules_whatever_version_is_asked_for(tmp_path: Path) -> None:
    code = """
        def sysCall_init():
            assert require('sim') is sim and require('sim-2') is sim
            assert not simROS and require('simROS') is simROS
            try:
                require('simFoo')
            except ImportError as error:
                print(error)
    """
    assert lines(tmp_path, code) == [
        "module 'simFoo' not found; require supports sim, simUI, simIK, simOMPL, simVision, simIM, simRemoteApi, "
        "simROS, simROS2"
    ]


def test_header_includes_files_from_the_script_folder_and_the_script_path(tmp_path: Path) -> None:
    other = tmp_path / "other"
    other.mkdir()
    write(tmp_path / "near.py", "near = 'near'\n")
    write(other / "far.py", "far = 'far'\n")
    file = write(tmp_path / "script.py", "#python\ninclude near\ninclude far\ndef sysCall_init(): print(near, far)\n")
    options = ["--no-ros", "--speed", "max", "--until", 0.05, "--child-script", f"/Ball={file}"]
    run = run_sim("ball", *options, "--script-path", other)
    assert (run.stdout, without_slowness(run.stderr), run.returncode) == ("near far\n", "", 0)


def test_line_numbers_hold_below_an_include(tmp_path: Path) -> None:
    write(tmp_path / "near.py", "x = 1\n")
    run = run_script(tmp_path, "#python\ninclude near\ndef sysCall_init():\n    nothing\n")
    assert f"{tmp_path}/script.py:4)" in run.stderr


def test_scripts_hold_any_letters(tmp_path: Path) -> None:
    code = """
        def sysCall_init(): print('Zürich 東京 🤖')
    """
    assert lines(tmp_path, code) == ["Zürich 東京 🤖"]


def test_dataclasses_work_in_scripts(tmp_path: Path) -> None:
    code = """
        from __future__ import annotations
        from dataclasses import dataclass
        @dataclass
        class Wheel:
            radius: float = 0.5
        def sysCall_init(): print(Wheel())
    """
    assert lines(tmp_path, code) == ["Wheel(radius=0.5)"]


def test_descendants_come_before_ancestors_and_siblings_in_scene_order(tmp_path: Path) -> None:
    options = ["--no-ros", "--speed", "max", "--until", 0.05]
    for target in ("/Tricycle/FrontSonar", "/Tricycle", "/Tricycle/FrontMotor", "/Tricycle/Steering"):
        name = target.rpartition("/")[2]
        file = write(tmp_path / f"{name}.py", f"def sysCall_init(): print('{name}')\n")
        options += ["--child-script", f"{target}={file}"]
    run = run_sim("tricycle", *options)
    names = run.stdout.split()
    assert sorted(names) == ["FrontMotor", "FrontSonar", "Steering", "Tricycle"]
    assert names[-1] == "Tricycle"
    assert names.index("FrontSonar") == 0
    assert names.index("Steering") < names.index("FrontMotor")


def test_collecting_garbage_passes_over_what_was_imported(tmp_path: Path) -> None:
    """A full collection of all of it would stop a step for a fiftieth of a second."""
    code = """
        import gc
        def sysCall_init(): print(len(gc.get_objects()) < gc.get_freeze_count())
    """
    assert lines(tmp_path, code) == ["True"]
