# SPDX-License-Identifier: BSD-3-Clause
"""Suggestions for unknown names of a script module."""

from __future__ import annotations

import difflib
from collections.abc import Mapping

from bubblesim.messages.names import did_you_mean

# The same function in simROS and simROS2.
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
_MIN_PREFIX = 6  # minimum length for a suggestion by prefix
_IN_MODULE = {
    "simROS": {theirs: ours for ours, theirs in _COUNTERPARTS},
    "simROS2": dict(_COUNTERPARTS),
}


def explain(module: str, wanted: str, modules: Mapping[str, type]) -> str:
    """Return the error message for an unknown name, with suggestions.

    :param modules: the classes of all modules by name.
    """
    counterpart = _IN_MODULE.get(module, {}).get(wanted)
    if counterpart is not None:
        other = "simROS2" if module == "simROS" else "simROS"
        return f"{module} has no {wanted}, which is a function of {other}; use {module}.{counterpart}"
    elsewhere = [f"{name}.{wanted}" for name, other in modules.items() if wanted in _names(other)]
    near = [f"{module}.{name}" for name in _near(wanted, _names(modules[module]))]
    hint = did_you_mean(elsewhere or near) or "; `bubblesim api` lists all functions"
    return f"{module} has no {wanted}{hint}"


def _near(wanted: str, known: list[str]) -> list[str]:
    """Return at most two names: first those that start with ``wanted``."""
    longer = sorted((name for name in known if name.startswith(wanted)), key=len) if len(wanted) >= _MIN_PREFIX else []
    return list(dict.fromkeys([*longer, *difflib.get_close_matches(wanted, known, n=2)]))[:2]


def _names(module: type) -> list[str]:
    return [name for name in dir(module) if not name.startswith("_")]
