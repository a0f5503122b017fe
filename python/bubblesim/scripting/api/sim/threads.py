# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for sysCall_thread."""

from __future__ import annotations

import time

from bubblesim._core import RunState
from bubblesim.scripting.api.checked_calls import any_time
from bubblesim.scripting.api.sim.context import ApiContext
from bubblesim.scripting.threads.script_thread import AnyThread, current

_TOLERANCE = 1e-6  # of a step


class ThreadFunctions(ApiContext):
    """A script's thread is suspended after 2 ms in each step, or, in stepping mode, only in ``step``."""

    @any_time
    def setStepping(self, enable: bool) -> int:
        """Enable or disable stepping mode, in which the thread is suspended only in ``step``; calls nest.

        Returns the previous nesting depth.
        """
        thread = self._thread("setStepping")
        before = thread.stepping
        thread.stepping = before + 1 if enable else max(0, before - 1)
        return before

    @any_time
    def setThreadAutomaticSwitch(self, enable: bool) -> int:
        """The opposite of ``setStepping``, for older scripts."""
        return self.setStepping(not enable)

    @any_time
    def acquireLock(self) -> None:
        """Prevent suspension until ``releaseLock``."""
        self.setStepping(True)

    @any_time
    def releaseLock(self) -> None:
        """Undo one ``acquireLock``."""
        self.setStepping(False)

    @any_time
    def step(self) -> None:
        """Wait for the next step."""
        self._thread("step").step()

    @any_time
    def switchThread(self) -> None:
        """Wait for the next step."""
        self._thread("switchThread").step()

    @any_time
    def wait(self, seconds: float, simulation_time: bool = True) -> float:
        """Wait for a number of seconds of simulated time, or of wall time; return the excess time."""
        thread = self._thread("wait")
        if not simulation_time:
            begin = time.monotonic()
            thread.sleep(seconds)
            return time.monotonic() - begin - seconds
        with thread.turn():
            end = self._simulation.time + seconds
        while True:
            with thread.turn():
                left = end - self._simulation.time
                if left <= _TOLERANCE * self._simulation.time_step:
                    return float(max(0.0, -left))
            thread.step()

    @any_time
    def getThreadExitRequest(self) -> bool:
        """Return whether the thread is requested to end."""
        thread = current()
        return thread is not None and thread.exit_requested

    @any_time
    def getSimulationStopping(self) -> bool:
        """Return whether this is the last step, or the simulation has ended after it."""
        return self.getThreadExitRequest() or bool(self._runner.state == RunState.STOPPING)

    def _thread(self, function: str) -> AnyThread:
        thread = current()
        if thread is None:
            raise RuntimeError(f"sim.{function} is only allowed in sysCall_thread: other callbacks must not wait")
        return thread
