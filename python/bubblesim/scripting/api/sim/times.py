# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for simulation time and run state."""

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

_started = time.monotonic()  # this module is loaded at the start of the simulator


def _seconds_since_start() -> float:
    return time.monotonic() - _started


class TimeFunctions(ApiContext):
    """Simulation time in seconds starts at 0 and is constant during a step.

    After the physics, in sysCall_sensing, objects and readings show the end of the step, one time step later.
    """

    def getSimulationTime(self) -> float:
        """Return the simulated time in seconds: the start of the step, also in sysCall_sensing."""
        return float(self._simulation.time)

    def getSimulationTimeStep(self) -> float:
        """Return the duration of a step in seconds."""
        return float(self._simulation.time_step)

    def setSimulationTimeStep(self, seconds: float) -> None:
        """Set the duration of steps, 0.0001 to 10 s, from this step until the simulation stops.

        Physics substeps become shorter if necessary, never longer.
        """
        self._simulation.set_time_step(seconds)

    def getSystemTime(self) -> float:
        """Return the wall time in seconds since the start of the node."""
        return _seconds_since_start()

    def getSystemTimeInMs(self, previous: int = -1) -> int:
        """Return milliseconds since the start of the node (-1) or the epoch (-2), or since ``previous``."""
        if previous == -2:
            return time.time_ns() // 1_000_000
        now = int(_seconds_since_start() * 1000)
        return now if previous == -1 else now - previous

    def getSimulationState(self) -> int:
        """Return sim.simulation_advancing_running, simulation_paused or simulation_advancing_lastbeforestop."""
        return _STATES[self._runner.state]

    def pauseSimulation(self) -> None:
        """Pause after this step."""
        self._runner.pause(wait=False)

    def startSimulation(self) -> None:
        """Continue after a pause, or restart a stopped simulation."""
        self._runner.start(wait=False)

    def stopSimulation(self) -> None:
        """Stop after one more step and reset the scene; the node ends if nothing can start the simulation again."""
        self._runner.stop(wait=False)

    def quitSimulator(self) -> None:
        """End the node after this step."""
        self._runner.end(wait=False)
