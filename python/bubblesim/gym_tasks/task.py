# SPDX-License-Identifier: BSD-3-Clause
"""A task: a scene, what an agent does and sees in it, its rewards and the ends of its episodes.

All methods but `place` work on many worlds at once: arrays have a row for each.
"""

from __future__ import annotations

import importlib
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, ClassVar

import gymnasium
import numpy as np
import numpy.typing as npt

import bubblesim

Array = npt.NDArray[Any]
SCENES = Path(__file__).resolve().parent / "scenes"


class Task(ABC):
    """Rules of some worlds of one scene. SI units."""

    scene: ClassVar[str]  # name or path
    actions: ClassVar[Sequence[str]]  # quantities that are commanded
    observations: ClassVar[Sequence[str]]  # quantities that are read
    camera: ClassVar[str] = "/RenderCamera"  # path of the camera for pictures
    steps: ClassVar[int] = 1  # simulation steps in a step of the environment
    randomize: ClassVar[Mapping[str, bubblesim.Distribution]] = {}  # quantities that are drawn for each episode
    action_delay: ClassVar[bubblesim.Distribution | int] = 0  # steps of the environment
    observation_delay: ClassVar[bubblesim.Distribution | int] = 0  # likewise; rewards are not delayed
    action_space: gymnasium.Space[Any]
    observation_space: gymnasium.spaces.Box

    def __init__(self, worlds: int) -> None:
        """Make the rules for a number of worlds."""
        self.worlds = worlds

    @abstractmethod
    def place(self, world: int, simulation: bubblesim.Simulation, random: np.random.Generator) -> None:
        """Begin an episode in a world that was reset: move things to random places."""

    @abstractmethod
    def commands(self, actions: Array) -> Array:
        """Return the values of the quantities in `actions` for actions of the agent."""

    @abstractmethod
    def observe(self, rows: Array) -> Array:
        """Return what the agent sees; ``rows`` holds the quantities in `observations`."""

    @abstractmethod
    def judge(self, rows: Array) -> tuple[Array, Array, dict[str, Array]]:
        """Return rewards, whether episodes have terminated, and information, after a step."""

    def begin(self, marks: Array, rows: Array) -> None:  # noqa: B027  # most tasks need nothing
        """Remember what rewards need of the first state of the marked worlds' episodes."""


def make_task(name: str | type[Task], worlds: int) -> Task:
    """Make a task from its class, or from "MODULE:CLASS"."""
    if isinstance(name, str):
        module, _, attribute = name.partition(":")
        name = getattr(importlib.import_module(module), attribute)
    assert isinstance(name, type)
    return name(worlds)


def headings(quaternions: Array) -> Array:
    """Return the rotations about z, rad, of quaternions x, y, z, w in rows."""
    x, y, z, w = quaternions.T
    return np.asarray(np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)))


def upright(heading: float) -> list[float]:
    """Return the quaternion of a rotation about z, rad."""
    return [0.0, 0.0, float(np.sin(heading / 2)), float(np.cos(heading / 2))]
