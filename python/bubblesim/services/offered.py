# SPDX-License-Identifier: BSD-3-Clause
"""Which services and topics the node offers to control the simulation."""

from __future__ import annotations

from bubblesim.observers.lock_step import LockStep
from bubblesim.observers.observed_bridge import ObservedBridge, Observer
from bubblesim.scripting.host.host import ScriptHost
from bubblesim.services.gazebo_services import GazeboServices
from bubblesim.services.gazebo_topics import GazeboTopics
from bubblesim.services.model_services import ModelServices
from bubblesim.services.object_services import ObjectServices
from bubblesim.services.reset_services import offer_reset_services
from bubblesim.services.simulation_topics import SimulationTopics
from bubblesim.services.step_service import offer_step_service


class Control:
    """Made by the simulator's node, which calls ``process_input`` and ``publish`` in these phases of a step."""

    def __init__(self, host: ScriptHost, *, gazebo_compat: bool) -> None:
        """Offer all of them, through the host's bridge; Gazebo's only on demand."""
        ObjectServices(host.simulation, host.bridge)  # lives in its callbacks
        ModelServices(host)
        offer_reset_services(host.bridge, host)
        self._observers: list[Observer] = host.bridge.observers if isinstance(host.bridge, ObservedBridge) else []
        lock_step = next((observer for observer in self._observers if isinstance(observer, LockStep)), None)
        offer_step_service(host.bridge, host.simulation, lock_step)
        self._topics = SimulationTopics(host.bridge, host.simulation)
        self._gazebo: GazeboTopics | None = None
        if gazebo_compat:
            GazeboServices(host)
            self._gazebo = GazeboTopics(host.bridge, host.simulation.world)

    def process_input(self) -> None:
        """When messages have been delivered."""
        self._topics.tell_state()
        for observer in self._observers:
            observer.input_processed()

    def publish(self) -> None:
        """At the end of a step, when all else of it has been published."""
        if self._gazebo is not None:
            self._gazebo.publish()
        self._topics.tell_pass()
        for observer in self._observers:
            observer.pass_done()

    def close(self) -> None:
        """When all scripts have ended for good."""
        for observer in self._observers:
            observer.close()
