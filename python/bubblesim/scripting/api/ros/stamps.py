# SPDX-License-Identifier: BSD-3-Clause
"""Time stamps in the headers of messages."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

Message = Mapping[str, Any]


def stamps(message: Message) -> Iterator[float]:
    """Yield the time stamps, s, of the headers of a message and of its transforms; the message must fit its type."""
    transforms = message.get("transforms", ())
    for stamped in (message, *(transforms if isinstance(transforms, list) else ())):
        header = stamped.get("header")
        if isinstance(header, Mapping) and "stamp" in header:
            yield _seconds(header["stamp"])


def now(bridge: Any) -> dict[str, int]:
    """Return ROS time as {sec, nanosec}, for stamps."""
    sec, nanosec = bridge.now()
    return {"sec": sec, "nanosec": nanosec}


def _seconds(stamp: Any) -> float:
    if not isinstance(stamp, Mapping):
        return float(stamp)
    whole = stamp.get("secs", stamp.get("sec", 0))
    return float(whole) + float(stamp.get("nsecs", stamp.get("nanosec", 0))) * 1e-9
