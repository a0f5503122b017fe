# SPDX-License-Identifier: BSD-3-Clause
"""Which function was meant by a name that a module of scripts does not have."""

from __future__ import annotations

import difflib
from collections.abc import Mapping

from bubblesim.messages.names import did_you_mean

# The same function under the names of simROS and of simROS2.
_COUNTERPARTS = (
    ("advertise", "createPublisher"),
    ("subscribe", "createSubscription"),
    ("serviceClient", "createClient"),
    ("advertiseService", "createService"),
    ("shutdownSubscriber", "shutdownSubscription"),
    ("shutdownServiceClient", "shutdownClient"),
    ("shutdownServiceServer", "shutdownService"),
    ("subscriberTreatUInt8ArrayAsString", "subscriptionTreatUInt8ArrayAsString"),
    ("serviceClientTreatUInt8ArrayAsString", "clientTreatUInt8ArrayAsString"),
    ("serviceServerTreatUInt8ArrayAsString", "serviceTreatUInt8ArrayAsString"),
    ("imageTransportAdvertise", "imageTransportCreatePublisher"),
    ("imageTransportSubscribe", "imageTransportCreateSubscription"),
    ("imageTransportShutdownSubscriber", "imageTransportShutdownSubscription"),
)
_TELLING = 6  # letters that say what a name begins with
_IN_MODULE = {
    "simROS": {theirs: ours for ours, theirs in _COUNTERPARTS},
    "simROS2": dict(_COUNTERPARTS),
}


def explain(module: str, wanted: str, modules: Mapping[str, type]) -> str:
    """The text of an error: ``module`` has no ``wanted``, and what it has.

    :param modules: the classes of all modules by name.
    """
    counterpart = _IN_MODULE.get(module, {}).get(wanted)
    if counterpart is not None:
        other = "simROS2" if module == "simROS" else "simROS"
        return f"{module} has no {wanted}, which belongs to {other}; its counterpart is {module}.{counterpart}"
    elsewhere = [f"{name}.{wanted}" for name, other in modules.items() if wanted in _names(other)]
    near = [f"{module}.{name}" for name in _near(wanted, _names(modules[module]))]
    hint = did_you_mean(elsewhere or near) or "; `bubblesim api` lists all functions that there are"
    return f"{module} has no {wanted}{hint}"


def _near(wanted: str, known: list[str]) -> list[str]:
    """At most two names: first those that go on where this one was cut off."""
    longer = sorted((name for name in known if name.startswith(wanted)), key=len) if len(wanted) >= _TELLING else []
    return list(dict.fromkeys([*longer, *difflib.get_close_matches(wanted, known, n=2)]))[:2]


def _names(module: type) -> list[str]:
    return [name for name in dir(module) if not name.startswith("_")]
