# SPDX-License-Identifier: BSD-3-Clause
"""A script that waits in rospy for a ROS master that does not run."""

from __future__ import annotations

import socket
import sys
from urllib.parse import urlsplit

from bubblesim.program.addresses import master_uri

_TIMEOUT = 0.5  # s for the master's answer


def waits_for_master(thread: int) -> str:
    """Return the end of a warning if a thread is in a function of rospy and no master answers; else empty."""
    frame = sys._current_frames().get(thread)
    while frame is not None and not str(frame.f_globals.get("__name__")).startswith("rospy."):
        frame = frame.f_back
    if frame is None or _answers(master_uri()):
        return ""
    return (
        f"; rospy waits for the ROS master at {master_uri()}, which does not answer: start roscore, "
        "or use simROS in place of rospy"
    )


def _answers(uri: str) -> bool:
    address = urlsplit(uri)
    try:
        socket.create_connection((address.hostname or "", address.port or 80), _TIMEOUT).close()
    except (OSError, ValueError):
        return False
    return True
