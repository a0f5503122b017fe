# SPDX-License-Identifier: BSD-3-Clause
"""Which services and topics the node offers to control the simulation."""

from __future__ import annotations

from bubblesim.control.model_services import ModelServices
from bubblesim.control.object_services import ObjectServices
from bubblesim.control.reset_services import offer_reset_services
from bubblesim.control.simulation_topics import SimulationTopics
from bubblesim.control.step_service import offer_step_service
from bubblesim.scripting.host import ScriptHost


class Control:
    """Made by the simulator's node, which calls ``drain`` and ``publish`` in these phases of a pass."""

    def __init__(self, host: ScriptHost) -> None:
        """Offer all of them, through the host's bridge."""
        ObjectServices(host.simulation, host.bridge)  # lives in its callbacks
        ModelServices(host)
        offer_reset_services(host.bridge, host)
        offer_step_service(host.bridge, host.simulation)
        topics = SimulationTopics(host.bridge, host.simulation)
        self.drain = topics.tell_state
        self.publish = topics.tell_pass
