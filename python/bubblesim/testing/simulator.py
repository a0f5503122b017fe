# SPDX-License-Identifier: BSD-3-Clause
"""A simulator that a test runs for as long as it wants."""

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
_PATIENCE = 30.0  # s
_POLL = 0.03  # s; each look keeps the master from answering the nodes for some milliseconds
_PASSES_IN_A_CALL = 200
_TOLERANCE = 1e-6  # of a second

Message = tuple[float, Any]  # simulated seconds, and a message as rospy has it


class Simulator:
    """The node with a scene, standing still but for the time that `run` lets pass."""

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

        :param bag: what it writes.
        :param scene: name of a scene, or path of an .sdf file.
        :param lockstep: the topics that a controller publishes once for each step.
        :param options: more options of the node.
        :raises RunError: with what it says, when it does not start.
        """
        self.time = 0.0
        self.bag = bag
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
        """Let so much simulated time pass; with `lockstep`, each step waits for the controller's answer.

        :raises RunError: when the controller does not answer any more, or a program has ended; with what it said last.
        """
        end = self.time + seconds
        while self.time < end - _TOLERANCE:
            left = round((end - self.time) / self._time_step) if self._time_step else 1
            self._run_steps(min(max(left, 1), _PASSES_IN_A_CALL))

    def _run_steps(self, steps: int) -> None:
        before = self.time
        try:
            answer = self._step.call(steps=steps)
        except ConnectionError:
            self._programs.check()
            raise
        self.time = answer["time"]
        if not answer["success"]:
            self._programs.check()  # one that has ended is the better reason
            raise RunError(answer["status_message"])
        self._time_step = self._time_step or (self.time - before) / steps

    def position(self, path: str) -> tuple[float, float, float]:
        """Where an object is, metres in the world's frame.

        :raises LookupError: naming similar objects.
        """
        position = self._ask(path)["pose"]["position"]
        return position["x"], position["y"], position["z"]

    def orientation(self, path: str) -> tuple[float, float, float, float]:
        """How an object is turned in the world, quaternion x, y, z, w; LookupError naming similar objects."""
        turn = self._ask(path)["pose"]["orientation"]
        return turn["x"], turn["y"], turn["z"], turn["w"]

    def messages(self, topic: str) -> list[Message]:
        """What scripts published or heard on a topic, with simulated seconds. Ends the simulator."""
        import rosbag  # takes its time

        self.close()
        with rosbag.Bag(str(self.bag)) as bag:
            return [(stamp.to_sec(), message) for _, message, stamp in bag.read_messages(topics=[topic])]

    def close(self) -> None:
        """End it, which completes its bag."""
        self._step.close()
        self._state.close()
        self._node.stop()

    def _ask(self, path: str) -> dict[str, Any]:
        try:
            return self._state.call(object=path)
        except RuntimeError as error:  # what the service says
            raise LookupError(str(error)) from None

    def _client(self, name: str, service_type: str) -> ServiceClient:
        from bubblesim.testing.service_client import ServiceClient  # takes its time, and so does the node meanwhile

        deadline = time.monotonic() + _PATIENCE
        while (address := self._master.find_service(f"{_NODE}/{name}")) is None:
            self._programs.check()
            if time.monotonic() > deadline:
                raise RunError(f"the simulator does not offer its service {name}")
            time.sleep(_POLL)
        return ServiceClient(address, f"{_NODE}/{name}", service_type)
