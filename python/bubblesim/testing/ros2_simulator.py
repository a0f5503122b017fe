# SPDX-License-Identifier: BSD-3-Clause
"""A simulator on ROS 2 controlled by a test: without ROS, as a remote client does."""

from __future__ import annotations

import contextlib
import re
import time
from collections.abc import Sequence
from pathlib import Path

import zmq

from bubblesim.remote.connection import Connection, connect
from bubblesim.running.processes import Programs, RunError
from bubblesim.testing.any_simulator import AnySimulator, Message, check_start
from bubblesim.testing.mcap_messages import read_messages

_TIMEOUT = 30.0  # s for an answer
_POLL = 0.0005  # s
_PORT = re.compile(r"remote clients can connect to tcp://127\.0\.0\.1:(\d+)")
_WAITS = re.compile(r"^warning: (lockstep waits.*)$", re.MULTILINE)


class Ros2Simulator(AnySimulator):
    """The node with a scene, which waits except during `run`."""

    _node_options = ("--ros=2", "--remote=0", "_use_sim_time:=true")

    def __init__(
        self,
        programs: Programs,
        bag: Path,
        scene: str,
        lockstep: Sequence[str] = (),
        seed: int = 0,
        options: Sequence[str] = (),
    ) -> None:
        """Start it; see AnySimulator."""
        token = bag.with_suffix(".token")  # the port is open to all users of the machine
        super().__init__(programs, bag, scene, lockstep, seed, [f"--remote-token={token}", *options])
        self._connection: Connection = connect(self._port(), token=token, timeout=_TIMEOUT)
        self._sim = self._connection.sim
        self._sim.setStepping(True)
        self._sim.startSimulation()
        self._time_step: float = self._sim.getSimulationTimeStep()
        self._step_is_requested = False
        self._output_before = 0  # characters of the node's output at the last step

    def _run_steps(self, seconds: float) -> None:
        """Run one step."""
        if not self._step_is_requested:  # by a run that has failed
            self._sim.step(False)
            self._step_is_requested = True
        begin = time.monotonic()
        while (now := self._now()) < self.time + self._time_step / 2:
            self._check_progress(time.monotonic() - begin)
            time.sleep(_POLL)
        self.time = now
        self._step_is_requested = False

    def _now(self) -> float:
        self._programs.check()
        try:
            return float(self._sim.getSimulationTime())
        except TimeoutError as error:
            self._programs.check()  # a program that has ended is the better explanation
            raise RunError(f"the simulator does not answer: {error}") from None

    def _check_progress(self, waited: float) -> None:
        """Raise RunError if the node has reported why the step does not begin."""
        reasons = _WAITS.findall(self._node.output()[self._output_before :]) if waited > 1.0 else []
        if reasons:
            try:
                check_start(reasons[-1], waited)
            except RunError:
                self._output_before = len(self._node.output())
                raise

    def _pose(self, path: str) -> list[float]:
        try:
            return [float(number) for number in self._sim.getObjectPose(self._sim.getObject(path))]
        except RuntimeError as error:
            raise LookupError(str(error)) from None

    def _recorded(self, topic: str) -> list[Message]:
        return [(at, message) for _, message, at in read_messages(self.bag, topic)]

    def close(self) -> None:
        """End the node, which completes its bag."""
        with contextlib.suppress(TimeoutError, RuntimeError, zmq.ZMQError):  # it has ended, or was closed before
            self._sim.pauseSimulation()  # it would go on when its client is gone
        self._connection.close()
        super().close()

    def _port(self) -> int:
        deadline = time.monotonic() + _TIMEOUT
        while (found := _PORT.search(self._node.output())) is None:
            self._programs.check()
            if time.monotonic() > deadline:
                raise RunError(f"the simulator does not listen to the test:\n{self._node.output()}")
            time.sleep(0.02)
        return int(found[1])
