# SPDX-License-Identifier: BSD-3-Clause
"""Which services and topics the node offers to control the simulation."""

from __future__ import annotations

from bubblesim.control.gazebo_services import GazeboServices
from bubblesim.control.gazebo_topics import GazeboTopics
from bubblesim.control.model_services import ModelServices
from bubblesim.control.object_services import ObjectServices
from bubblesim.control.reset_services import offer_reset_services
from bubblesim.control.simulation_topics import SimulationTopics
from bubblesim.control.step_service import offer_step_service
from bubblesim.scripting.host import ScriptHost


class Control:
    """Made by the simulator's node, which calls ``drain`` and ``publish`` in these phases of a pass."""

    def __init__(self, host: ScriptHost, *, gazebo_compat: bool) -> None:
        """Offer all of them, through the host's bridge; Gazebo's only on demand."""
        ObjectServices(host.simulation, host.bridge)  # lives in its callbacks
        ModelServices(host)
        offer_reset_services(host.bridge, host)
        offer_step_service(host.bridge, host.simulation)
        self._topics = SimulationTopics(host.bridge, host.simulation)
        self.drain = self._topics.tell_state
        self._gazebo: GazeboTopics | None = None
        if gazebo_compat:
            GazeboServices(host)
            self._gazebo = GazeboTopics(host.bridge, host.simulation.world)

    def publish(self) -> None:
        """At the end of a pass, when all else of it has been published."""
        if self._gazebo is not None:
            self._gazebo.publish()
        self._topics.tell_pass()
