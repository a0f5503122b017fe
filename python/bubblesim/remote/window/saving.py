# SPDX-License-Identifier: BSD-3-Clause
"""The scene as the text of a file. The server of the window writes it: remote clients need no right to files."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from bubblesim.remote.window.window import Window
from bubblesim.scene_state.saved_scene import scene_text


def get_scene_text(window: Window, folder: str) -> str:
    """Return the scene as SDFormat for a file in this folder.

    :raises RuntimeError: while it runs or is paused after a step: a file has no velocities.
    """
    simulation = window.simulation
    if window.runner.state.name != "STOPPED" and simulation.time > 0:
        raise RuntimeError("stop the simulation before you save the scene: a file has no velocities")
    return scene_text(simulation, window.edits, Path(folder))


FUNCTIONS: tuple[Callable[..., Any], ...] = (get_scene_text,)
