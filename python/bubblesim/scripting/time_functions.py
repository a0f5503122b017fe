# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions that tell the time and control the simulation."""

from __future__ import annotations

import time

from bubblesim.scripting.context import ApiContext

_started: float | None = None


def _seconds_since_first_call() -> float:
    global _started
    if _started is None:
        _started = time.monotonic()
    return time.monotonic() - _started


class TimeFunctions(ApiContext):
    """Simulation time in seconds starts at 0 and is constant through a pass."""

    def getSimulationTime(self) -> float:
        """Simulated seconds."""
        return float(self._simulation.time)

    def getSimulationTimeStep(self) -> float:
        """Seconds that one pass takes."""
        return float(self._simulation.time_step)

    def getSystemTime(self) -> float:
        """Seconds of the machine's clock since the first call."""
        return _seconds_since_first_call()

    def getSystemTimeInMs(self, previous: int = -1) -> int:
        """Milliseconds since the first call (-1) or the epoch (-2), or passed since ``previous``."""
        if previous == -2:
            return time.time_ns() // 1_000_000
        now = int(_seconds_since_first_call() * 1000)
        return now if previous == -1 else now - previous

    def getSimulationState(self) -> int:
        """sim.simulation_advancing_running, simulation_paused or simulation_advancing_lastbeforestop."""
        if self._script.host.last_pass:
            return self.simulation_advancing_lastbeforestop
        return self.simulation_paused if self._simulation.paused else self.simulation_advancing_running

    def pauseSimulation(self) -> None:
        """Pause after this pass."""
        self._simulation.pause()

    def startSimulation(self) -> None:
        """Go on after a pause."""
        self._simulation.resume()

    def stopSimulation(self) -> None:
        """Stop after one more pass."""
        self._simulation.stop()
