# SPDX-License-Identifier: BSD-3-Clause
"""The last message of a node, over a connection that takes its time."""

import time
from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import Any

import pytest
from rospy.impl.tcpros_base import Transport
from rospy.impl.tcpros_pubsub import QueuedConnection
from std_msgs.msg import Float32

from bubblesim.nodes.last_message import send_last


class SlowTransport(Transport):  # type: ignore[misc]
    """Sends a message in half a second, as on a busy machine."""

    def __init__(self) -> None:
        super().__init__(direction="o")
        self.sent: list[Any] = []

    def write_data(self, data: Any) -> None:
        time.sleep(0.5)
        self.sent.append(data)


@pytest.fixture
def transport() -> Iterator[SlowTransport]:
    transport = SlowTransport()
    yield transport
    transport.close()


@pytest.mark.parametrize("queued", [True, False])
def test_the_last_message_is_sent_even_after_another_one(transport: SlowTransport, queued: bool) -> None:
    connection = QueuedConnection(transport, 1) if queued else transport
    publish: Callable[[Float32], None] = connection.write_data
    publisher: Any = SimpleNamespace(impl=SimpleNamespace(connections=[connection]), publish=publish)
    publish(Float32(1.0))
    send_last((publisher, Float32(0.0)))
    assert Float32(0.0) in transport.sent
