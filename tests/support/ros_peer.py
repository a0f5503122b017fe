# SPDX-License-Identifier: BSD-3-Clause
"""A rospy node at the other end of a robot's topics, in its own process."""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from peer_process import PeerProcess
from ros_support import DEADLINE, RosCore, wait_until

Message = dict[str, Any]


class Peer(PeerProcess):
    """Publishes and receives messages as dicts; bytes stay bytes."""

    def __init__(self, core: RosCore, log: Path) -> None:
        program = str(Path(__file__).with_name("ros_peer_node.py"))
        super().__init__([sys.executable, "-u", program], core.env, log)
        self._subscribed = {"response"}

    def publish(self, topic: str, message_type: str, message: Message) -> None:
        """Publish once the topic has a subscriber."""
        self._send(do="publish", topic=topic, type=message_type, message=message)

    def drive(self, topic: str, forward: float, turning: float) -> None:
        self.publish(topic, "geometry_msgs/Twist", {"linear": {"x": forward}, "angular": {"z": turning}})

    def received(self, topic: str, message_type: str = "") -> list[Message]:
        """Return all messages since the first call for the topic, which must give its type."""
        if topic not in self._subscribed:
            self._subscribed.add(topic)
            self._send(do="subscribe", topic=topic, type=message_type)
        else:  # a latched message may have come: it is after the call, too
            self._take_in()
        return self._received.setdefault(topic, [])

    def next(self, topic: str, message_type: str = "", *, count: int = 1) -> Message:
        """Return the count-th message after those received so far."""
        before = len(self.received(topic, message_type))
        wait_until(lambda: len(self.received(topic)) >= before + count, f"{topic}, {count} times")
        return self.received(topic)[before + count - 1]

    def wait_for(self, topic: str, message_type: str, holds: Callable[[Message], bool], what: str) -> Message:
        """Return the first message from now on for which `holds` is true."""
        return Messages(self, topic, message_type).next(holds, what)

    def call(self, service: str, **request: Any) -> Message:
        """Return the response of a service, once it is available."""
        number = len(self._received.setdefault("response", []))
        self._send(do="call", topic=service, request=request)
        wait_until(lambda: len(self.received("response")) > number, f"a response of {service}")
        return self._received["response"][number]


class Messages:
    """The messages of a topic from the construction on; none is left out between two calls."""

    def __init__(self, peer: Peer, topic: str, message_type: str) -> None:
        self._peer, self._topic = peer, topic
        self._seen = len(peer.received(topic, message_type))

    def next(self, holds: Callable[[Message], bool], what: str) -> Message:
        """Return the first message for which `holds` is true, after the one that it returned before."""
        found: list[int] = []

        def look() -> bool:
            messages = self._peer.received(self._topic)
            found.extend(i for i in range(self._seen, len(messages)) if holds(messages[i]))
            return bool(found)

        wait_until(look, what, 3 * DEADLINE)
        self._seen = found[0] + 1
        return self._peer.received(self._topic)[found[0]]
