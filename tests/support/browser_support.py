# SPDX-License-Identifier: BSD-3-Clause
"""Models of CoppeliaSim's browser on the floor of an empty hall, for tests."""

from pathlib import Path

import bubblesim
from bubblesim.scripting.api.sim.browser_models import BROWSER_MODELS
from node_support import REFUSED, in_init, run_script


def placed(model_object: str) -> bubblesim.Simulation:
    """A simulation of a floor and of a model on it, without its script."""
    simulation = bubblesim.Simulation("p3dx_floor")
    simulation.remove_model(simulation.object("/PioneerP3DX").handle)
    model = next(each for each in BROWSER_MODELS if each.object == model_object)
    simulation.add_model(model.text(), name=model_object)
    return simulation


def script(folder: Path, body: str, rest: str = "", until: float = 0.2) -> None:
    """Run `body` in sysCall_init of a script of the floor; an error fails the test."""
    code = f"import math\n{REFUSED}{in_init(body)}{rest}"
    run = run_script(folder, code, "--strict", scene="p3dx_floor", target="/Floor", until=until)
    assert (run.stderr, run.returncode) == ("", 0)
