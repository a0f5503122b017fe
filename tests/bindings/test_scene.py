# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim.Scene: a file that is read once, for several simulations."""

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

import bubblesim

WARNED = """\
<sdf version="1.9">
  <model name="m">
    <link name="l"><kinematic>true</kinematic></link>
  </model>
</sdf>
"""


def hash_after(scene: bubblesim.Scene | str, steps: int, seed: int = 1) -> int:
    simulation = bubblesim.Simulation(scene, seed=seed)
    simulation.object("/FrontMotor").target_velocity = 2.0
    simulation.step(steps)
    return int(simulation.state_hash())


def test_simulations_of_a_scene_equal_those_of_its_name() -> None:
    scene = bubblesim.Scene("tricycle")
    assert scene.name == "tricycle"
    assert hash_after(scene, 20) == hash_after("tricycle", 20)
    assert hash_after(scene, 20) == hash_after(scene, 20)


def test_a_simulation_gives_its_scene_to_others() -> None:
    simulation = bubblesim.Simulation("tricycle")
    assert hash_after(simulation.scene, 5) == hash_after("tricycle", 5)


def test_threads_share_a_scene() -> None:
    scene = bubblesim.Scene("tricycle")
    with ThreadPoolExecutor(4) as threads:
        assert set(threads.map(lambda _: hash_after(scene, 50), range(8))) == {hash_after(scene, 50)}


def test_warnings_are_values_of_a_scene(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "warned.sdf"
    file.write_text(WARNED)
    scene = bubblesim.Scene(str(file))
    assert capfd.readouterr().err == ""
    (warning,) = scene.warnings
    assert warning.startswith(f"{file}:3: /m/l: <kinematic> is ignored")
    bubblesim.Simulation(scene)
    assert capfd.readouterr().err == ""
    assert bubblesim.Simulation(str(file)).scene.warnings == scene.warnings
    assert capfd.readouterr().err == f"warning: {warning}\n"


def test_warnings_of_a_bad_file_are_printed_too(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "bad.sdf"
    file.write_text(WARNED.replace("<kinematic>", "<inertial><mass>-1</mass></inertial><kinematic>"))
    with pytest.raises(bubblesim.SceneError, match="-1"):
        bubblesim.Simulation(str(file))
    assert "<kinematic> is ignored" in capfd.readouterr().err


def test_a_name_of_no_scene_is_reported() -> None:
    with pytest.raises(bubblesim.SceneError, match="did you mean tricycle"):
        bubblesim.Scene("tricylce")
