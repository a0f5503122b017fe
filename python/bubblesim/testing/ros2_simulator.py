# SPDX-License-Identifier: BSD-3-Clause
"""A simulator on ROS 2 controlled by a test."""

from __future__ import annotations

import contextlib
import re
import time
from collections.abc import Sequence
from pathlib import Path

import zmq

from bubblesim.observers.lock_step import BEFORE_THE_CONTROLLER
from bubblesim.remote.connection import Connection, connect
from bubblesim.running.places import node_program
from bubblesim.running.processes import Programs, RunError
from bubblesim.testing.mcap_messages import Message, read_messages

_TIMEOUT = 30.0  # s for an answer
_STARTING_TIMEOUT = 20.0  # s until a controller is connected; longer than the node waits in a step
_POLL = 0.0005  # s
_TOLERANCE = 1e-6  # of a second
_PORT = re.compile(r"remote clients can connect to tcp://127\.0\.0\.1:(\d+)")
_WAITS = re.compile(r"^warning: (lockstep waits.*)$", re.MULTILINE)


class Ros2Simulator:
    """The node with a scene, which waits except during `run`. It is controlled without ROS, as a remote client does."""

    def __init__(
        self,
        programs: Programs,
        bag: Path,
        scene: str,
        lockstep: Sequence[str] = (),
        seed: int = 0,
        options: Sequence[str] = (),
    ) -> None:
        """Start it.

        :param bag: the .mcap file to write.
        :param scene: name of a scene, or path of an .sdf file.
        :param lockstep: topics that a controller publishes once in each step.
        :param options: additional options of the node.
        :raises RunError: with its output, if it does not start.
        """
        self.time = 0.0
        self.bag = bag
        bag.with_suffix(".scene").write_text(scene)  # over which its path is drawn
        self._programs = programs
        token = bag.with_suffix(".token")  # the port is open to all users of the machine
        steps = [argument for topic in lockstep for argument in ("--lockstep", topic)]
        self._node = programs.start(
            "simulator",
            *[str(node_program()), scene, "--ros=2", "--remote=0", f"--remote-token={token}", "--speed", "max"],
            *["--seed", str(seed), "--record", str(bag), *steps, *options, "_use_sim_time:=true"],
        )
        self._connection: Connection = connect(self._port(), token=token, timeout=_TIMEOUT)
        self._sim = self._connection.sim
        self._sim.setStepping(True)
        self._sim.startSimulation()
        self._time_step: float = self._sim.getSimulationTimeStep()
        self._step_is_requested = False
        self._output_before = 0  # characters of the node's output at the last step

    def run(self, seconds: float) -> None:
        """Run for this simulated time, s; with `lockstep`, each step waits for the controller's messages.

        :raises RunError: with the last output, if the controller does not publish in time, or a program has ended.
        """
        end = self.time + seconds
        while self.time < end - _TOLERANCE:
            self._run_step()

    def _run_step(self) -> None:
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
        if reasons and (not reasons[-1].startswith(BEFORE_THE_CONTROLLER) or waited > _STARTING_TIMEOUT):
            self._output_before = len(self._node.output())
            raise RunError(reasons[-1])

    def position(self, path: str) -> tuple[float, float, float]:
        """Return the position of an object, metres in the world frame.

        :raises LookupError: with similar names.
        """
        x, y, z = self._sim.getObjectPosition(self._object(path))
        return float(x), float(y), float(z)

    def orientation(self, path: str) -> tuple[float, float, float, float]:
        """Return the orientation of an object in the world, x, y, z, w; raise LookupError with similar names."""
        x, y, z, w = self._sim.getObjectQuaternion(self._object(path))
        return float(x), float(y), float(z), float(w)

    def messages(self, topic: str) -> list[Message]:
        """Return the messages of scripts on a topic, sent and received, with simulated times. Ends the simulator."""
        self.close()
        return [(at, message) for _, message, at in read_messages(self.bag, topic)]

    def close(self) -> None:
        """End the node, which completes its bag."""
        with contextlib.suppress(TimeoutError, RuntimeError, zmq.ZMQError):  # it has ended, or was closed before
            self._sim.pauseSimulation()  # it would go on when its client is gone
        self._connection.close()
        self._node.stop()

    def _object(self, path: str) -> int:
        try:
            return int(self._sim.getObject(path))
        except RuntimeError as error:
            raise LookupError(str(error)) from None

    def _port(self) -> int:
        deadline = time.monotonic() + _TIMEOUT
        while (found := _PORT.search(self._node.output())) is None:
            self._programs.check()
            if time.monotonic() > deadline:
                raise RunError(f"the simulator does not listen to the test:\n{self._node.output()}")
            time.sleep(0.02)
        return int(found[1])
