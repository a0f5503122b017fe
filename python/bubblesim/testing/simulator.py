# SPDX-License-Identifier: BSD-3-Clause
"""A simulator controlled by a test."""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bubblesim.running.places import node_program
from bubblesim.running.processes import Programs, RunError
from bubblesim.testing.master import Master

if TYPE_CHECKING:
    from bubblesim.testing.service_client import ServiceClient

_NODE = "/sim_ros_interface"
_TIMEOUT = 30.0  # s
_STARTING_TIMEOUT = 20.0  # s until a controller is connected; longer than the node waits in a step
_POLL = 0.03  # s; each query keeps the master from other nodes for some milliseconds
_STEPS_PER_CALL = 200
_TOLERANCE = 1e-6  # of a second

Message = tuple[float, Any]  # simulated time in seconds, and a message as a rospy object


class Simulator:
    """The node with a scene, paused except during `run`."""

    def __init__(
        self,
        master: Master,
        programs: Programs,
        bag: Path,
        scene: str,
        lockstep: Sequence[str] = (),
        seed: int = 0,
        options: Sequence[str] = (),
    ) -> None:
        """Start it.

        :param bag: the bag file to write.
        :param scene: name of a scene, or path of an .sdf file.
        :param lockstep: topics that a controller publishes once in each step.
        :param options: additional options of the node.
        :raises RunError: with its output, if it does not start.
        """
        self.time = 0.0
        self.bag = bag
        bag.with_suffix(".scene").write_text(scene)  # over which its path is drawn
        self._programs = programs
        self._time_step = 0.0  # s; unknown before the first step
        steps = [argument for topic in lockstep for argument in ("--lockstep", topic)]
        self._node = programs.start(
            "simulator",
            *[str(node_program()), scene, "--paused", "--speed", "max", "--seed", str(seed)],
            *["--record", str(self.bag), *steps, *options],
        )
        self._master = master
        self._step = self._client("step", "bubblesim_msgs/Step")
        self._state = self._client("get_object_state", "bubblesim_msgs/GetObjectState")

    def run(self, seconds: float) -> None:
        """Run for this simulated time, s; with `lockstep`, each step waits for the controller's messages.

        :raises RunError: with the last output, if the controller does not publish in time, or a program has ended.
        """
        end = self.time + seconds
        while self.time < end - _TOLERANCE:
            left = round((end - self.time) / self._time_step) if self._time_step else 1
            self._run_steps(min(max(left, 1), _STEPS_PER_CALL))

    def _run_steps(self, steps: int) -> None:
        from bubblesim.observers.lock_step import BEFORE_THE_CONTROLLER  # loads slowly, while the node also starts

        before = self.time
        deadline = time.monotonic() + _STARTING_TIMEOUT
        while problem := self._try_steps(steps):
            self._programs.check()  # a program that has ended is the better explanation
            if not problem.startswith(BEFORE_THE_CONTROLLER) or time.monotonic() > deadline:
                raise RunError(problem)
        self._time_step = self._time_step or (self.time - before) / steps

    def _try_steps(self, steps: int) -> str:
        """Return why not all steps were done; empty if they were."""
        try:
            answer = self._step.call(steps=steps)
        except ConnectionError:
            self._programs.check()
            raise
        self.time = answer["time"]
        return "" if answer["success"] else str(answer["status_message"])

    def position(self, path: str) -> tuple[float, float, float]:
        """Return the position of an object, metres in the world frame.

        :raises LookupError: with similar names.
        """
        position = self._object_state(path)["pose"]["position"]
        return position["x"], position["y"], position["z"]

    def orientation(self, path: str) -> tuple[float, float, float, float]:
        """Return the orientation of an object in the world, x, y, z, w; raise LookupError with similar names."""
        turn = self._object_state(path)["pose"]["orientation"]
        return turn["x"], turn["y"], turn["z"], turn["w"]

    def messages(self, topic: str) -> list[Message]:
        """Return the messages of scripts on a topic, sent and received, with simulated times. Ends the simulator."""
        import rosbag  # loads slowly

        self.close()
        with rosbag.Bag(str(self.bag)) as bag:
            return [(stamp.to_sec(), message) for _, message, stamp in bag.read_messages(topics=[topic])]

    def close(self) -> None:
        """End the node, which completes its bag."""
        self._step.close()
        self._state.close()
        self._node.stop()

    def _object_state(self, path: str) -> dict[str, Any]:
        try:
            return self._state.call(object=path)
        except RuntimeError as error:  # error message of the service
            raise LookupError(str(error)) from None

    def _client(self, name: str, service_type: str) -> ServiceClient:
        from bubblesim.testing.service_client import ServiceClient  # loads slowly, while the node also starts

        deadline = time.monotonic() + _TIMEOUT
        while (address := self._master.find_service(f"{_NODE}/{name}")) is None:
            self._programs.check()
            if time.monotonic() > deadline:
                raise RunError(f"the simulator does not advertise its service {name}")
            time.sleep(_POLL)
        return ServiceClient(address, f"{_NODE}/{name}", service_type)
