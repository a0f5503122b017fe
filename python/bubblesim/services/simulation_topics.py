# SPDX-License-Identifier: BSD-3-Clause
"""The topics of CoppeliaSim's ROS helper, with which other nodes control and observe the simulation.

Names, types and values are those of the helper. While a script uses one of the names, it is released.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bubblesim import _core
from bubblesim._core import RunState

CONTROLS = ("/startSimulation", "/pauseSimulation", "/stopSimulation", "/enableSyncMode", "/triggerNextStep")
"""Topics to which the simulator subscribes, whatever the scene."""
_QUEUE = 10
_QUEUE_OF_STEPS = 1000  # large, so that nodes can count steps
_UNLIMITED = 0
_STATES = {RunState.STOPPED: 0, RunState.RUNNING: 1, RunState.STOPPING: 1, RunState.PAUSED: 2}


class SimulationTopics:
    """Advertised during the lifetime of the bridge."""

    def __init__(self, bridge: Any, runner: Any) -> None:
        """Subscribe and advertise."""
        self._bridge = bridge
        self._runner = runner
        self._subscribe("/startSimulation", lambda _: runner.start(wait=False))
        self._subscribe("/pauseSimulation", lambda _: runner.pause(wait=False))
        self._bridge.set_priority(self._subscribe("/stopSimulation", lambda _: runner.stop(wait=False)))
        self._subscribe("/enableSyncMode", lambda enable: runner.set_synchronous(enable, wait=False))
        self._subscribe("/triggerNextStep", lambda _: runner.trigger_step(wait=False), _UNLIMITED)
        self._state = self._advertise("/simulationState", "std_msgs/Int32", _QUEUE)
        self._time = self._advertise("/simulationTime", "std_msgs/Float32", _QUEUE_OF_STEPS)
        self._step_done = self._advertise("/simulationStepDone", "std_msgs/Bool", _QUEUE_OF_STEPS)

    def _subscribe(self, topic: str, action: Callable[[bool], None], queue_size: int = _QUEUE) -> int:
        subscriber: int = self._bridge.subscribe(
            topic, "std_msgs/Bool", lambda message: action(message["data"]), queue_size, _core.messages.TimeForm.FLOAT
        )
        self._bridge.yield_topic(subscriber)
        return subscriber

    def _advertise(self, topic: str, message_type: str, queue_size: int) -> int:
        publisher = int(self._bridge.advertise(topic, message_type, queue_size))
        self._bridge.yield_topic(publisher)
        return publisher

    def publish_state(self) -> None:
        """Publish the state; called before each step, and regularly without steps."""
        if self._bridge.wants_messages(self._state):
            self._bridge.publish(self._state, {"data": _STATES[self._runner.state]})

    def publish_step_done(self) -> None:
        """Publish time and step done; called at the end of a step, after all other messages of the step."""
        if self._bridge.wants_messages(self._time):
            self._bridge.publish(self._time, {"data": self._runner.simulation.time})
        if self._bridge.wants_messages(self._step_done):
            self._bridge.publish(self._step_done, {"data": True})
