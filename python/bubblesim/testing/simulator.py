# SPDX-License-Identifier: BSD-3-Clause
"""A simulator on ROS 1 controlled by a test: by the services of the node."""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bubblesim.running.processes import Programs, RunError
from bubblesim.testing.any_simulator import AnySimulator, Message, check_start
from bubblesim.testing.master import Master

if TYPE_CHECKING:
    from bubblesim.testing.service_client import ServiceClient

_NODE = "/sim_ros_interface"
_TIMEOUT = 30.0  # s
_POLL = 0.03  # s; each query keeps the master from other nodes for some milliseconds
_STEPS_PER_CALL = 200


class Simulator(AnySimulator):
    """The node with a scene, paused except during `run`."""

    _node_options = ("--paused",)

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
        """Start it on a master; see AnySimulator."""
        super().__init__(programs, bag, scene, lockstep, seed, options)
        self._time_step = 0.0  # s; unknown before the first step
        self._master = master
        self._step = self._client("step", "bubblesim_msgs/Step")
        self._state = self._client("get_object_state", "bubblesim_msgs/GetObjectState")

    def _run_steps(self, seconds: float) -> None:
        before = self.time
        steps = min(max(round(seconds / self._time_step), 1), _STEPS_PER_CALL) if self._time_step else 1
        begin = time.monotonic()
        while problem := self._try_steps(steps):
            self._programs.check()  # a program that has ended is the better explanation
            check_start(problem, time.monotonic() - begin)
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

    def _pose(self, path: str) -> list[float]:
        try:
            pose: dict[str, Any] = self._state.call(object=path)["pose"]
        except RuntimeError as error:  # error message of the service
            raise LookupError(str(error)) from None
        return [*(pose["position"][axis] for axis in "xyz"), *(pose["orientation"][axis] for axis in "xyzw")]

    def _recorded(self, topic: str) -> list[Message]:
        import rosbag  # loads slowly

        with rosbag.Bag(str(self.bag)) as bag:
            return [(stamp.to_sec(), message) for _, message, stamp in bag.read_messages(topics=[topic])]

    def close(self) -> None:
        """End the node, which completes its bag."""
        self._step.close()
        self._state.close()
        super().close()

    def _client(self, name: str, service_type: str) -> ServiceClient:
        from bubblesim.testing.service_client import ServiceClient  # loads slowly, while the node also starts

        deadline = time.monotonic() + _TIMEOUT
        while (address := self._master.find_service(f"{_NODE}/{name}")) is None:
            self._programs.check()
            if time.monotonic() > deadline:
                raise RunError(f"the simulator does not advertise its service {name}")
            time.sleep(_POLL)
        return ServiceClient(address, f"{_NODE}/{name}", service_type)
