# SPDX-License-Identifier: BSD-3-Clause
"""Transport hints of a `simROS` subscriber."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from bubblesim.scripting.api.kinds import FLAG, INTEGER, Kind, shown

_KEYS = ("transports", "tcpNoDelay", "maxDatagramSize")
_TRANSPORTS = ("reliable", "tcp", "unreliable", "udp")
_MAX_DATAGRAM = 65507  # bytes, over IPv4


@dataclass(frozen=True)
class TransportHints:
    """The requested transport: whether UDP is preferred, and TCP without delay."""

    wants_udp: bool = False
    tcp_no_delay: bool = True


def read_transport_hints(given: Mapping[str, Any] | None) -> TransportHints:
    """Read a dict such as ``{'transports': ['unreliable', 'reliable'], 'maxDatagramSize': 1000}``.

    UDP is not supported: roscpp aborts the process by an assertion if a publisher has only TCP, as those of rospy.

    :raises TypeError, ValueError: with the valid keys and values.
    """
    if given is None:
        return TransportHints()
    if not isinstance(given, Mapping):
        raise TypeError(f"transport hints must be a dict, found {shown(given)}")
    for key in given:
        if key not in _KEYS:
            raise ValueError(f"transport hints have no {key!r}; valid keys: {', '.join(_KEYS)}")
    datagram = _of_kind("maxDatagramSize", INTEGER, given.get("maxDatagramSize", 0))
    if not 0 <= datagram <= _MAX_DATAGRAM:
        raise ValueError(f"maxDatagramSize must be 0 to {_MAX_DATAGRAM} bytes, found {datagram}")
    first = _first_transport(given.get("transports", []))
    return TransportHints(first in ("unreliable", "udp"), _of_kind("tcpNoDelay", FLAG, given.get("tcpNoDelay", True)))


def _first_transport(names: Any) -> str:
    if not isinstance(names, list | tuple):
        raise TypeError(f"transports must be a list, found {shown(names)}")
    for name in names:
        if not isinstance(name, str) or name not in _TRANSPORTS:
            raise ValueError(f"transports must hold {', '.join(map(repr, _TRANSPORTS))}; found {shown(name)}")
    return str(names[0]) if names else "tcp"


def _of_kind(key: str, kind: Kind, value: Any) -> Any:
    try:
        return kind.convert(value)
    except (TypeError, ValueError, OverflowError):
        raise TypeError(f"{key} must be {kind.words}, found {shown(value)}") from None
