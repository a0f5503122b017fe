# SPDX-License-Identifier: BSD-3-Clause
"""`sim` functions for sysCall_thread."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from bubblesim._core import RunState
from bubblesim.scripting.api.checked_calls import any_time
from bubblesim.scripting.api.sim.context import ApiContext
from bubblesim.scripting.api.waiting_functions import Waiting
from bubblesim.scripting.threads.script_thread import SLICE, AnyThread, current

_TOLERANCE = 1e-6  # of a step


class ThreadFunctions(ApiContext):
    """A script's thread is suspended after 2 ms in each step, or, in stepping mode, only in ``step``."""

    run_waiting: Callable[[Waiting], Any] | None = None
    """Runs functions that take several steps, for scripts whose threads are none of the operating system."""

    @any_time
    def setStepping(self, enable: bool) -> int:
        """Enable or disable stepping mode, in which the thread is suspended only in ``step``; calls nest.

        Returns the previous nesting depth. In sysCall_init it is for the thread that starts afterwards.
        """
        owner = current() or self._caller
        before = owner.stepping
        owner.stepping = before + 1 if enable else max(0, before - 1)
        return before

    @any_time
    def setThreadAutomaticSwitch(self, enable: bool) -> int:
        """The opposite of ``setStepping``, for older scripts."""
        return self.setStepping(not enable)

    @any_time
    def getStepping(self) -> int:
        """Return the nesting depth of stepping mode."""
        return (current() or self._caller).stepping

    @any_time
    def getThreadAutomaticSwitch(self) -> bool:
        """Return whether stepping mode is off, for older scripts."""
        return self.getStepping() == 0

    @any_time
    def setThreadSwitchTiming(self, milliseconds: float) -> None:
        """Set how long the turns of the calling thread last outside of stepping mode, for older scripts.

        Raises ValueError for a negative time.
        """
        self.setAutoYieldDelay(milliseconds / 1000)

    @any_time
    def getThreadSwitchTiming(self) -> float:
        """Return how long the turns of the calling thread last, ms, for older scripts."""
        thread = current()
        return 1000 * (SLICE if thread is None else thread.slice)

    @any_time
    def setAutoYieldDelay(self, seconds: float) -> None:
        """Set how long the turns of the calling thread last outside of stepping mode, instead of 2 ms.

        Raises ValueError for a negative time. Outside of a thread it has no effect.
        """
        if not seconds >= 0:
            raise ValueError(f"a turn of {seconds:g} s: it must be 0 or more")
        if (thread := current()) is not None:
            thread.slice = seconds

    @any_time
    def setThreadSwitchAllowed(self, allowed: bool) -> int:
        """The opposite of ``setStepping``, for older scripts."""
        return self.setStepping(not allowed)

    @any_time
    def getThreadSwitchAllowed(self) -> int:
        """Return 1 if stepping mode is off, else 0, for older scripts."""
        return int(self.getStepping() == 0)

    def isScriptExecutionThreaded(self) -> int:
        """Return 1 in a thread, else 0, for older scripts."""
        return int(current() is not None)

    def isScriptRunningInThread(self) -> int:
        """Return 1 in a thread, else 0, for older scripts."""
        return int(current() is not None)

    def setThreadIsFree(self, free: bool) -> None:
        """For older scripts: a thread in Python that waits for a socket is free."""

    def setThreadResumeLocation(self, location: int, order: int = 0) -> None:
        """For older scripts: threads go on before sysCall_actuation."""

    def getThreadId(self) -> int:
        """Return 0 outside of a thread, and a number above 0 in one."""
        thread = current()
        return 0 if thread is None else (thread.ident or 1)

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
        """Wait for a number of seconds of simulated time, or of wall time; return the time left, which is 0 or, for the
        time in excess, negative."""
        thread = self._thread("wait")
        if not simulation_time:
            begin = time.monotonic()
            thread.sleep(seconds)
            return seconds - (time.monotonic() - begin)
        with thread.turn():
            end = self._simulation.time + seconds
        while True:
            with thread.turn():
                left = end - self._simulation.time
                if left <= _TOLERANCE * self._simulation.time_step:
                    return float(min(0.0, left))
            thread.step()

    @any_time
    def waitForSignal(self, name: str) -> int | float | str | bytes:
        """Wait until a signal is set, of any type, and return it."""
        thread = self._thread("waitForSignal")
        while True:
            with thread.turn():
                for kind in (int, float, str):
                    value: int | float | str | bytes | None = self._caller.shared.signals.get((kind, name))
                    if value is not None:
                        return value
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

    def _run_waiting(self, function: str, waiting: Waiting) -> Any:
        """Return the result of a function that takes several steps."""
        if self.run_waiting is not None:
            return self.run_waiting(waiting)
        thread = self._thread(function)
        while True:
            with thread.turn():
                try:
                    next(waiting)
                except StopIteration as end:
                    return end.value
            thread.step()

    def _thread(self, function: str) -> AnyThread:
        thread = current()
        if thread is None:
            raise RuntimeError(f"sim.{function} is only allowed in sysCall_thread: other callbacks must not wait")
        return thread
