# SPDX-License-Identifier: BSD-3-Clause
"""What the simulators that a test controls have in common, with any version of ROS."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from bubblesim.running.places import node_program
from bubblesim.running.processes import Programs, RunError

_STARTING_TIMEOUT = 20.0  # s until a controller is connected; longer than the node waits in a step
_TOLERANCE = 1e-6  # of a second

Message = tuple[float, Any]  # simulated time in seconds, and a message: its fields are attributes


class AnySimulator(ABC):
    """The node with a scene, which waits except during `run`."""

    _node_options: Sequence[str] = ()  # with which the node waits, and can be controlled

    def __init__(
        self,
        programs: Programs,
        bag: Path,
        scene: str,
        lockstep: Sequence[str] = (),
        seed: int = 0,
        options: Sequence[str] = (),
    ) -> None:
        """Start it.

        :param bag: the file to write: .bag, or .mcap on ROS 2.
        :param scene: name of a scene, or path of an .sdf file.
        :param lockstep: topics that a controller publishes once in each step.
        :param options: additional options of the node.
        :raises RunError: with its output, if it does not start.
        """
        self.time = 0.0
        self.bag = bag
        bag.with_suffix(".scene").write_text(scene)  # over which its path is drawn
        self._programs = programs
        steps = [argument for topic in lockstep for argument in ("--lockstep", topic)]
        self._node = programs.start(
            "simulator",
            *[str(node_program()), scene, *self._node_options, "--speed", "max", "--seed", str(seed)],
            *["--record", str(bag), *steps, *options],
        )

    def run(self, seconds: float) -> None:
        """Run for this simulated time, s; with `lockstep`, each step waits for the controller's messages.

        :raises RunError: with the last output, if the controller does not publish in time, or a program has ended.
        """
        end = self.time + seconds
        while self.time < end - _TOLERANCE:
            self._run_steps(end - self.time)

    def position(self, path: str) -> tuple[float, float, float]:
        """Return the position of an object, metres in the world frame.

        :raises LookupError: with similar names.
        """
        x, y, z, *_ = self._pose(path)
        return x, y, z

    def orientation(self, path: str) -> tuple[float, float, float, float]:
        """Return the orientation of an object in the world, x, y, z, w; raise LookupError with similar names."""
        _, _, _, x, y, z, w = self._pose(path)
        return x, y, z, w

    def messages(self, topic: str) -> list[Message]:
        """Return the messages of scripts on a topic, sent and received, with simulated times. Ends the simulator."""
        self.close()
        return self._recorded(topic)

    def close(self) -> None:
        """End the node, which completes its bag."""
        self._node.stop()

    @abstractmethod
    def _run_steps(self, seconds: float) -> None:
        """Run one step or several, of at most this time in s, and set `time`."""

    @abstractmethod
    def _pose(self, path: str) -> Sequence[float]:
        """Return x, y, z and the quaternion x, y, z, w of an object; raise LookupError with similar names."""

    @abstractmethod
    def _recorded(self, topic: str) -> list[Message]:
        """Return the messages of a topic in the complete bag."""


def check_start(problem: str, waited: float) -> None:
    """Raise RunError for a problem of a step, unless a controller may still be starting.

    :param waited: s since the step was requested.
    """
    from bubblesim.observers.lock_step import BEFORE_THE_CONTROLLER  # loads slowly, while the node also starts

    if not problem.startswith(BEFORE_THE_CONTROLLER) or waited > _STARTING_TIMEOUT:
        raise RunError(problem)
