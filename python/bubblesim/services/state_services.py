# SPDX-License-Identifier: BSD-3-Clause
"""The services ~save_state and ~restore_state."""

from __future__ import annotations

from typing import Any

from bubblesim import _core
from bubblesim.scripting.host.host import ScriptHost
from bubblesim.services.answers import Message, report_errors


def advertise_state_services(bridge: Any, host: ScriptHost) -> None:
    """Advertise both in the node's namespace; they run between steps."""
    simulation = host.simulation

    def save(_: Message) -> Message:
        return {"state": simulation.save()}

    def restore(request: Message) -> Message:
        simulation.restore(bytes(request["state"]))
        return {}

    for name, answer in (("SaveState", save), ("RestoreState", restore)):
        topic = "~save_state" if name == "SaveState" else "~restore_state"
        bridge.advertise_service(topic, f"bubblesim_msgs/{name}", report_errors(answer), _core.messages.TimeForm.FLOAT)
