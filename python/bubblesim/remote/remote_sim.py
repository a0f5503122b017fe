# SPDX-License-Identifier: BSD-3-Clause
"""`sim` for remote clients: the functions of scripts, of which those that wait are answered later."""

from __future__ import annotations

import threading
from pathlib import Path
from typing import Any

from bubblesim._core import RunState
from bubblesim.remote.remote_client import Conversation, Pending, RemoteCallback, RemoteClient
from bubblesim.scripting.api.functions import variant_of_module
from bubblesim.scripting.api.sim.sim_module import SimApi

_TOLERANCE = 1e-6  # of a step
_CALLS_OF_TEST = 99


@variant_of_module("sim")
class RemoteSim(SimApi):
    """Functions and constants of `sim` for one client."""

    _caller: RemoteClient

    def setStepping(self, enable: bool) -> int:
        """Enable or disable stepping mode, in which a step waits for ``step`` of this client; calls nest."""
        client = self._caller
        before = client.level
        client.level = before + 1 if enable else max(0, before - 1)
        if client.level == 0:
            client.granted = 0
        client.door.stepping_changed()
        return before

    def step(self, wait: bool = True) -> Any:
        """Let the next step run, and wait until it is done; without stepping mode, wait for the next step."""
        if self._stopped():
            return None
        if self._caller.level:
            self._caller.granted += 1
        return self._after_step() if wait else None

    def switchThread(self) -> Any:
        """Do the same as ``step``."""
        return self.step()

    def wait(self, seconds: float, simulation_time: bool = True) -> Any:
        """Wait for a number of seconds of simulated time, or of wall time; return the excess time."""
        if not simulation_time:
            return self._wait_for_wall_time(seconds)
        if self._stopped():
            raise RuntimeError("sim.wait: the simulation is stopped, its time does not pass")
        end = self._simulation.state_time + seconds
        client = self._caller

        def is_done() -> bool:
            passed = bool(self._simulation.state_time >= end - _TOLERANCE * self._simulation.time_step)
            client.waits_for_time = not (passed or self._stopped())
            return not client.waits_for_time

        if is_done():
            return 0.0
        return Pending(is_done, lambda: float(max(0.0, self._simulation.state_time - end)))

    def getSimulationStopping(self) -> bool:
        """Return whether this is the last step."""
        return bool(self._runner.state == RunState.STOPPING)

    def getThreadExitRequest(self) -> bool:
        """Return whether this is the last step (old name)."""
        return self.getSimulationStopping()

    def startSimulation(self) -> Any:
        """Start a stopped simulation, or continue after a pause."""
        self._runner.start(wait=False)
        return self._after_commands()

    def pauseSimulation(self) -> Any:
        """Pause between two steps."""
        self._runner.pause(wait=False)
        return self._after_commands()

    def stopSimulation(self, wait: bool = True) -> Any:
        """Stop after one more step and reset the scene; this ends the stepping modes of all clients."""
        self._runner.stop(wait=False)
        return self._after_commands(fits_the_end=True)

    def loadScene(self, file: str) -> Any:
        """See SimApi.loadScene."""
        self._require_this_scene(file)
        return self.closeScene()

    def closeScene(self) -> Any:
        """See SimApi.closeScene."""
        self._runner.stop(wait=False)
        pending = self._after_commands()
        self._caller.door.after_commands(self._remove_created)
        pending.result = lambda: 1
        return pending

    def testCB(self, first: Any, callback: Any, second: Any, calls: int = _CALLS_OF_TEST) -> Conversation:
        """Call a function of the client several times, and return what it returns at last."""
        if not isinstance(callback, RemoteCallback):
            raise TypeError(f"sim.testCB: argument 2, callback: expected a function, found {type(callback).__name__}")

        def conversation() -> Conversation:
            result = None
            for _ in range(calls + 1):
                result = yield callback.name, (first, second)
            return result

        return conversation()

    def _stopped(self) -> bool:
        return bool(self._runner.state == RunState.STOPPED)

    def _after_step(self) -> Pending:
        door = self._caller.door
        before = door.steps
        return Pending(lambda: door.steps > before or self._stopped())

    def _after_commands(self, *, fits_the_end: bool = False) -> Pending:
        carried_out = threading.Event()
        self._caller.door.after_commands(carried_out.set)
        return Pending(carried_out.is_set, fits_the_end=fits_the_end)

    def _wait_for_wall_time(self, seconds: float) -> Pending:
        over = threading.Event()

        def end() -> None:
            over.set()
            self._caller.door.after_commands(lambda: None)

        timer = threading.Timer(max(0.0, seconds), end)
        timer.daemon = True
        timer.start()
        return Pending(over.is_set, lambda: 0.0)

    def _require_this_scene(self, file: str) -> None:
        own = Path(self._simulation.scene_file)
        if Path(file.replace("\\", "/")).stem != own.stem:
            raise RuntimeError(self._other_scene(file))

    def _remove_created(self) -> None:
        shared = self._caller.shared
        for model in [model for model in shared.loaded_models if self._tree.contains(model)]:
            self._remove_model(model)
        shared.loaded_models.clear()
        for handle in list(shared.dummies.by_handle):
            shared.dummies.remove(handle)
        shared.custom_data.clear()
