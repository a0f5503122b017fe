# SPDX-License-Identifier: BSD-3-Clause
"""The observers that the options of the node ask for."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from bubblesim.both_bridges import BothBridges
from bubblesim.observers.lock_step import LockStep
from bubblesim.observers.observed_bridge import ObservedBridge, Observer
from bubblesim.observers.recorder import Recorder, RecordingFile

MCAP = ".mcap"


class Observers:
    """Created by the simulator's node, which calls ``process_input`` and ``publish`` in each step."""

    def __init__(self, bridge: Any, runner: Any, record: str, lockstep: list[str]) -> None:
        """Make ``bridge``, which scripts are to use.

        :param record: file to write, empty for none: a bag, or FILE.mcap for ROS 2.
        :param lockstep: topics that each step waits for; see LockStep. With two bridges those of ROS 1.
        """
        self._observers: list[Observer] = []
        if not isinstance(bridge, BothBridges):
            self.bridge: Any = self._observed(bridge, runner, record, lockstep)
            return
        of_ros2 = record if record.endswith(MCAP) else ""
        ros1 = self._observed(bridge.ros1, runner, "" if of_ros2 else record, lockstep)
        self.bridge = BothBridges(ros1, self._observed(bridge.ros2, runner, of_ros2, []))

    def _observed(self, bridge: Any, runner: Any, record: str, lockstep: list[str]) -> Any:
        observers: list[Observer] = []
        if record:
            observers.append(Recorder(Path(record), _recording(Path(record)), bridge))
        lock_step = LockStep(lockstep, bridge, runner) if lockstep else None
        if lock_step:
            observers.append(lock_step)
        self._observers += observers
        return ObservedBridge(bridge, observers, keeps_all=bool(record), lockstep=lock_step)

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


def _recording(file: Path) -> RecordingFile:
    """Open a file; raise OSError on failure. Each kind is imported on demand: ROS 1's loads slowly."""
    if file.suffix == MCAP:
        from bubblesim.observers.mcap_file import McapRecording

        return McapRecording(file)
    from bubblesim.observers.bag_file import BagRecording

    return BagRecording(file)
