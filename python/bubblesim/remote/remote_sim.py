# SPDX-License-Identifier: BSD-3-Clause
"""`sim` for remote clients: the functions of scripts, of which those that wait are answered later."""

from __future__ import annotations

import math
import threading
import time
from pathlib import Path
from typing import Any

from bubblesim._core import RunState, Scene, cbor_decode
from bubblesim.remote.later_replies import Conversation, Pending
from bubblesim.remote.remote_client import RemoteCallback, RemoteClient
from bubblesim.scripting.api.functions import variant_of_module
from bubblesim.scripting.api.ik.ik_module import SimIk
from bubblesim.scripting.api.kinds import Bytes
from bubblesim.scripting.api.ompl.ompl_module import SimOmpl
from bubblesim.scripting.api.sim.scene_files import stem, stem_with_folder
from bubblesim.scripting.api.sim.sim_module import SimApi
from bubblesim.scripting.api.ui.ui_module import SimUi
from bubblesim.scripting.api.waiting_functions import Waiting

_TOLERANCE = 1e-6  # of a step
_CALLS_OF_TEST = 99
_LONGEST_WAIT = 86400.0  # s
_LONGEST_WAIT_FOR_THE_START = (
    2.0  # s, of functions that take steps: another client may be about to start the simulation
)


@variant_of_module("sim")
class RemoteSim(SimApi):
    """Functions and constants of `sim` for one client."""

    _caller: RemoteClient
    _most_unpacked = 1_000_000

    def __init__(self, runner: Any, caller: RemoteClient) -> None:
        """Bind the functions to one client."""
        super().__init__(runner, caller)
        self._other_modules: dict[str, Any] = {}

    def other_module(self, name: str) -> Any:
        """Return the client's simUI, simIK or simOMPL."""
        made = self._other_modules
        if name not in made:
            of_runner = {"simIK": SimIk, "simOMPL": SimOmpl}.get(name)
            made[name] = SimUi(self._caller) if of_runner is None else of_runner(self._runner, self._caller)
        return made[name]

    def setStepping(self, enable: bool) -> int:
        """Enable or disable stepping mode, in which a step waits for ``step`` of this client; calls nest."""
        client = self._caller
        before = client.level
        client.level = before + 1 if enable else max(0, before - 1)
        if client.level == 0:
            client.granted = 0
        client.server.stepping_changed()
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
        """Wait for a number of seconds of simulated time, or of wall time; return the time left: 0, or a
        negative number."""
        if not simulation_time:
            return self._wait_for_wall_time(seconds)
        if not math.isfinite(seconds):
            raise ValueError(f"sim.wait: {seconds:g} s is not a time to wait")
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
        return Pending(is_done, lambda: float(min(0.0, end - self._simulation.state_time)))

    def waitForSignal(self, name: str) -> Any:
        """Wait until a signal is set, of any type, and return it; None (nil) if the simulation stops before."""
        signals = self._caller.shared.signals

        def value() -> Any:
            return next((found for kind in (int, float, str) if (found := signals.get((kind, name))) is not None), None)

        return Pending(lambda: value() is not None or self._stopped(), value)

    def _run_waiting(self, function: str, waiting: Waiting) -> Any:
        """Let a function that takes several steps go on with each; in stepping mode it allows them itself.

        It waits a moment for the start of a simulation that is stopped.
        """
        client = self._caller
        server = client.server
        result: Any = None
        steps = -1

        def is_done() -> bool:
            nonlocal result, steps
            if self._stopped():
                if pending.due is None or time.monotonic() >= pending.due:
                    raise RuntimeError(f"sim.{function}: the simulation is stopped, its time does not pass")
                return False
            pending.due = None
            if server.steps == steps:
                return False
            steps = server.steps
            try:
                next(waiting)
            except StopIteration as end:
                result = end.value
                return True
            if client.level:
                client.granted += 1
            return False

        pending = Pending(is_done, lambda: result, due=time.monotonic() + _LONGEST_WAIT_FOR_THE_START)
        return pending

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
        return self._after_commands(accepts_the_end=True)

    def loadScene(self, file: str) -> Any:
        """See SimApi.loadScene."""
        self._require_changeable_scene("sim.loadScene")
        if not file:
            return self._change_scene(Scene.empty())
        folders = self._caller.server.folders
        names = dict.fromkeys((stem(file), stem_with_folder(file)))
        places = [folder / f"{name}{suffix}" for suffix in (".sdf", ".ttt") for name in names for folder in folders]
        own = Path(self._simulation.scene_file)
        if stem(file) == own.stem:  # also of another format than .sdf
            places.insert(0, own)
        found = self._find("sim.loadScene", "scene", file, places)
        return self._change_scene(self._simulation.scene if found.suffix == ".xacro" else Scene(str(found)))

    def closeScene(self) -> Any:
        """See SimApi.closeScene."""
        self._require_changeable_scene("sim.closeScene")
        return self._change_scene(Scene.empty())

    def unpackTable(self, data: Bytes) -> Any:
        """See SimApi.unpackTable; with the limits of a request, because the bytes are the client's."""
        try:
            return cbor_decode(data)
        except ValueError as error:
            raise ValueError(f"sim.unpackTable: the bytes are not a packed table: {error}") from None

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
        server = self._caller.server
        before = server.steps
        return Pending(lambda: server.steps > before or self._stopped())

    def _after_commands(self, *, accepts_the_end: bool = False) -> Pending:
        carried_out = threading.Event()
        self._caller.server.after_commands(carried_out.set)
        return Pending(carried_out.is_set, accepts_the_end=accepts_the_end)

    def _wait_for_wall_time(self, seconds: float) -> Pending:
        if not 0.0 <= seconds <= _LONGEST_WAIT:
            raise ValueError(f"sim.wait: {seconds:g} s is not a time to wait: from 0 to {_LONGEST_WAIT:g} (a day)")
        due = time.monotonic() + seconds
        return Pending(lambda: time.monotonic() >= due, lambda: 0.0, due=due)

    def _require_changeable_scene(self, function: str) -> None:
        if why := self._caller.server.fixed_scene:
            raise RuntimeError(f"{function}: the scene cannot be changed: {why}")

    def _change_scene(self, scene: Any) -> Pending:
        server = self._caller.server
        before = server.scenes

        def result() -> int:
            if server.failure:
                raise RuntimeError(server.failure)
            return 1

        self._runner.stop(wait=False)
        server.after_commands(lambda: server.change_scene(scene))
        return Pending(lambda: server.scenes > before, result)
