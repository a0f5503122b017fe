# SPDX-License-Identifier: BSD-3-Clause
"""The observers that the options of the node ask for."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from bubblesim.both_bridges import BothBridges
from bubblesim.observers.bag_recorder import BagRecorder
from bubblesim.observers.lock_step import LockStep
from bubblesim.observers.observed_bridge import ObservedBridge, Observer


class Observers:
    """Created by the simulator's node, which calls ``process_input`` and ``publish`` in each step."""

    def __init__(self, bridge: Any, runner: Any, record: str, lockstep: list[str]) -> None:
        """Make ``bridge``, which scripts are to use.

        :param record: file of the bag to write, empty for none.
        :param lockstep: topics that each step waits for; see LockStep.
        """
        both = bridge if isinstance(bridge, BothBridges) else None
        bridge = both.ros1 if both else bridge  # bags and lockstep are of ROS 1 then
        self._observers: list[Observer] = []
        if record:
            self._observers.append(BagRecorder(Path(record), bridge))
        lock_step = LockStep(lockstep, bridge, runner) if lockstep else None
        if lock_step:
            self._observers.append(lock_step)
        observed = ObservedBridge(bridge, self._observers, keeps_all=bool(record), lockstep=lock_step)
        self.bridge: Any = BothBridges(observed, both.ros2) if both else observed

    def process_input(self) -> None:
        """Notify the observers after input was processed."""
        for observer in self._observers:
            observer.input_processed()

    def publish(self) -> None:
        """Notify the observers after all messages of a step."""
        for observer in self._observers:
            observer.step_done()

    def close(self) -> None:
        """Close the observers after all scripts have ended."""
        for observer in self._observers:
            observer.close()
