# SPDX-License-Identifier: BSD-3-Clause
"""The last messages of a node that ends."""

from __future__ import annotations

import time

import genpy
import rospy

_TIMEOUT = 2.0  # s for a subscriber that does not read


def send_last(*messages: tuple[rospy.Publisher, genpy.Message]) -> None:
    """Publish each message and wait until it is sent: rospy sends from other threads, which end with the node."""
    end = time.monotonic() + _TIMEOUT
    # A thread takes the next message after it has sent the one before: when the second is taken, the first is sent.
    for _ in range(2):
        for publisher, message in messages:
            publisher.publish(message)
        while any(_waiting(publisher) for publisher, _ in messages) and time.monotonic() < end:
            time.sleep(0.01)
    time.sleep(0.1)  # roscpp does not read the rest of a connection after the publisher has closed it


def _waiting(publisher: rospy.Publisher) -> bool:
    # rospy has no public function for this. A connection without this queue sends at once.
    return any(getattr(connection, "_queue", None) for connection in publisher.impl.connections)
