# SPDX-License-Identifier: BSD-3-Clause
"""The services ~reset and ~reset_simulation."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bubblesim import _core
from bubblesim.scripting.host import ScriptHost


def offer_reset_services(bridge: Any, host: ScriptHost) -> None:
    """Offer both, as std_srvs/Empty, under the node's name; they are done when they answer."""
    for name, action in (("~reset", host.simulation.reset_world), ("~reset_simulation", host.restart)):
        bridge.advertise_service(name, "std_srvs/Empty", _answering(action), _core.messages.TimeForm.FLOAT)


def _answering(action: Callable[[], None]) -> Callable[[object], None]:
    def answer(request: object) -> None:
        try:
            action()
        except RuntimeError as error:  # a script asks for it in the middle of a pass
            raise _core.ServiceError(str(error)) from None

    return answer
