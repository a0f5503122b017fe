# SPDX-License-Identifier: BSD-3-Clause
"""Equal scenes, seeds and commands give equal states: in other processes, with a window, after resets, on processors
with other instruction sets. States are compared by their hash, readings of cameras and lidars by their numbers."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from node_support import run_sim
from ros_support import REPOSITORY

SCENES = sorted(file.stem for file in (REPOSITORY / "scenes").glob("*.sdf"))
STEP = 0.05  # s
PROCESSORS = {"Nehalem": "SSE4.2", "Haswell": "AVX2, FMA"}
"""Those that QEMU imitates, and the newest of their instructions that are used here; no AVX-512."""
NEAR = 1e-6  # m
PIXELS = 1e-4
"""The share of numbers of a picture that may differ."""

RESETS = """
import json, sys, bubblesim
found = {}
for scene in sys.argv[2:]:
    simulation = bubblesim.Simulation(scene, seed=11)
    hashes = set()
    for _ in range(int(sys.argv[1])):
        simulation.reset()
        simulation.step(40)
        hashes.add(simulation.state_hash())
    found[scene] = sorted(hashes)
print(json.dumps(found))
"""
READINGS = """
import sys, numpy as np, bubblesim
simulation = bubblesim.Simulation('sensors', seed=3)
simulation.step(10)
read = lambda name: simulation.object(name).reading
picture = read('/Camera')
np.savez(sys.argv[1], hash=np.uint64(simulation.state_hash()), lidar=read('/Lidar').ranges,
         rings=read('/RingLidar').ranges, depth=picture.depth, picture=picture.rgb, objects=picture.objects)
"""


def state_hash(scene: str, steps: int, *options: object, within: tuple[str, ...] = ()) -> str:
    """Return the hash at the end of a run with child scripts."""
    fixed = ("--no-ros", "--speed", "max", "--state-hash", "--seed", 5, "--until", steps * STEP)
    run = run_sim(scene, *fixed, *options, within=within, timeout=300)
    assert run.returncode == 0, run.stderr
    return run.stdout.splitlines()[-1]


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("steps", [1000, pytest.param(10_000, marks=pytest.mark.long)])
def test_in_each_process_with_and_without_a_window(scene: str, steps: int) -> None:
    first = state_hash(scene, steps)
    assert state_hash(scene, steps) == first
    assert state_hash(scene, steps, "--web") == first
    assert state_hash(scene, steps + 1) != first


def test_after_each_of_a_hundred_resets() -> None:
    def hashes(count: int) -> dict[str, list[int]]:
        command = [sys.executable, "-c", RESETS, str(count), *SCENES]
        run = subprocess.run(command, capture_output=True, text=True, check=True)
        return dict(json.loads(run.stdout))

    found = hashes(100)
    assert all(len(each) == 1 for each in found.values()), found
    assert hashes(1) == found


@pytest.fixture(params=PROCESSORS)
def imitated(request: pytest.FixtureRequest) -> tuple[str, ...]:
    """The command that runs another one as on an older processor."""
    program = shutil.which("qemu-x86_64")
    if program is None:
        pytest.skip("needs qemu-user, which scripts/setup --with tests installs")
    return (program, "-cpu", request.param)


@pytest.mark.parametrize(
    "scene", ["pioneer", *(pytest.param(each, marks=pytest.mark.long) for each in SCENES if each != "pioneer")]
)
def test_on_an_older_processor(imitated: tuple[str, ...], scene: str) -> None:
    assert state_hash(scene, 20, within=imitated) == state_hash(scene, 20)


def test_readings_on_an_older_processor_are_near(imitated: tuple[str, ...], tmp_path: Path) -> None:
    def readings(name: str, *within: str) -> dict[str, np.ndarray]:
        file = tmp_path / f"{name}.npz"
        interpreter = str(Path(sys.executable).resolve())  # QEMU does not follow the link of an environment
        subprocess.run([*within, interpreter, "-c", READINGS, str(file)], env=with_packages(), check=True)
        with np.load(file) as loaded:
            return dict(loaded)

    here, there = readings("here"), readings("there", *imitated)
    assert here["hash"] == there["hash"]
    for name in ("lidar", "rings", "depth"):
        np.testing.assert_allclose(there[name], here[name], rtol=0, atol=NEAR, err_msg=name)
    for name in ("picture", "objects"):
        assert np.mean(here[name] != there[name]) < PIXELS, name


def with_packages() -> dict[str, str]:
    """Return the environment for an interpreter that does not know the virtual environment."""
    return os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
