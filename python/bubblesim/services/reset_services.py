# SPDX-License-Identifier: BSD-3-Clause
"""The services ~reset and ~reset_simulation."""

from __future__ import annotations

from collections.abc import Container
from typing import Any

from bubblesim import _core
from bubblesim.scripting.host.host import ScriptHost
from bubblesim.services.answers import answering_empty


def advertise_reset_services(bridge: Any, host: ScriptHost, *, taken: Container[str] = ()) -> None:
    """Advertise both, as std_srvs/Empty, in the node's namespace; they respond when the reset is complete.

    :param taken: services that are not advertised, because the node has others of that name.
    """
    for name, action in (("~reset", host.simulation.reset_world), ("~reset_simulation", host.restart)):
        if name in taken:
            continue
        answer = answering_empty(action)
        bridge.set_priority(bridge.advertise_service(name, "std_srvs/Empty", answer, _core.messages.TimeForm.FLOAT))
