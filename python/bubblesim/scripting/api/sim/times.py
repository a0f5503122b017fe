# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that tell the time and control the simulation."""

from __future__ import annotations

import time

from bubblesim._core import RunState
from bubblesim.scripting.api.sim.constants import SimConstants
from bubblesim.scripting.api.sim.context import ApiContext

_STATES = {
    RunState.STOPPED: SimConstants.simulation_stopped,
    RunState.PAUSED: SimConstants.simulation_paused,
    RunState.RUNNING: SimConstants.simulation_advancing_running,
    RunState.STOPPING: SimConstants.simulation_advancing_lastbeforestop,
}

_started = time.monotonic()  # this is read when the simulator starts, long before a script calls anything


def _seconds_since_start() -> float:
    return time.monotonic() - _started


class TimeFunctions(ApiContext):
    """Simulation time in seconds starts at 0 and is constant through a step."""

    def getSimulationTime(self) -> float:
        """Simulated seconds."""
        return float(self._simulation.time)

    def getSimulationTimeStep(self) -> float:
        """Seconds that one step takes."""
        return float(self._simulation.time_step)

    def setSimulationTimeStep(self, seconds: float) -> None:
        """Let steps take so many seconds from this one on, 0.0001 to 10, until the simulation stops.

        Physics substeps become shorter when need be, never longer.
        """
        self._simulation.set_time_step(seconds)

    def getSystemTime(self) -> float:
        """Seconds of the machine's clock since the start of the node."""
        return _seconds_since_start()

    def getSystemTimeInMs(self, previous: int = -1) -> int:
        """Milliseconds since the start of the node (-1) or the epoch (-2), or passed since ``previous``."""
        if previous == -2:
            return time.time_ns() // 1_000_000
        now = int(_seconds_since_start() * 1000)
        return now if previous == -1 else now - previous

    def getSimulationState(self) -> int:
        """sim.simulation_advancing_running, simulation_paused or simulation_advancing_lastbeforestop."""
        return _STATES[self._simulation.state]

    def pauseSimulation(self) -> None:
        """Pause after this step."""
        self._simulation.pause()

    def startSimulation(self) -> None:
        """Go on after a pause, or start again when it has stopped."""
        self._simulation.start()

    def stopSimulation(self) -> None:
        """Stop after one more step, back to the start of the scene; the node ends when nobody could start it again."""
        self._simulation.stop()

    def quitSimulator(self) -> None:
        """End the node after this step."""
        self._simulation.end()
