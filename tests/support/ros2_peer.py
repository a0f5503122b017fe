# SPDX-License-Identifier: BSD-3-Clause
"""Real ROS 2 for tests: nodes of rclpy, from PyPI, in processes and an environment of their own.

Use as pytest fixtures: ``from ros2_peer import ros2_domain, ros2_peer``. They skip where rclpy or the ROS 2 side of the
node is missing.
"""

import base64
import os
import signal
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest

from bubblesim.running.isolation import reserve_domain
from node_support import clean_environment
from peer_process import PeerProcess
from ros_support import DEADLINE, REPOSITORY, stopped_on_failure, wait_until

Message = dict[str, Any]
PEERS = REPOSITORY / ".ws" / "ros2_peers"  # of Jazzy
KILTED_PEERS = REPOSITORY / ".ws" / "ros2_kilted_peers"
LIBRARY = REPOSITORY / ".ws" / "devel" / "lib" / "libbubblesim_ros2.so"

has_ros2 = pytest.mark.skipif(not LIBRARY.exists(), reason="built without ROS 2: scripts/setup --with ros2")


class Domain:
    """A ROS_DOMAIN_ID that no other test uses meanwhile."""

    def __init__(self) -> None:
        self.number, self._holder = reserve_domain()

    def env(self, **changes: str) -> dict[str, str]:
        """Return the environment for a process in this domain."""
        return clean_environment(ROS_DOMAIN_ID=str(self.number), PYTHONUNBUFFERED="1", **changes)

    def release(self) -> None:
        self._holder.close()


@pytest.fixture
def ros2_domain() -> Iterator[Domain]:
    if not LIBRARY.exists():
        pytest.skip("built without ROS 2: scripts/setup --with ros2")
    domain = Domain()
    yield domain
    domain.release()


def peer_environment(domain: Domain, peers: Path = PEERS, **changes: str) -> dict[str, str]:
    """Return the environment of rclpy: its own packages only."""
    if not (peers / "bin" / "python").exists():
        pytest.skip("rclpy is not installed: scripts/setup --with ros2 --with tests")
    env = domain.env(**changes)
    for name in ("LD_LIBRARY_PATH", "VIRTUAL_ENV", "_ROS_WHEELS_BOOTSTRAP_COMPLETE"):
        env.pop(name, None)
    return env


class Ros2Peer(PeerProcess):
    """A node `/peer` that publishes and receives messages as dicts; bytes stay bytes."""

    def __init__(self, domain: Domain, log: Path, within: Sequence[str] = (), peers: Path = PEERS, **env: str) -> None:
        """``within``: a program that runs the command which follows its arguments; ``peers``: where rclpy is."""
        program = str(Path(__file__).with_name("ros2_peer_node.py"))
        command = [*within, str(peers / "bin" / "python"), "-u", program]
        super().__init__(command, peer_environment(domain, peers, **env), log)
        self._subscribed: set[str] = set()
        with stopped_on_failure(self._process):
            self._wait_for("ready", 1)

    def publish(self, topic: str, message_type: str, message: Message, **qos: Any) -> None:
        """Publish once the topic has a subscriber."""
        self._send(do="publish", topic=topic, type=message_type, message=message, qos=qos)

    def send_bytes(self, topic: str, message_type: str, data: list[bytes]) -> None:
        """Publish serialized messages once the topic has a subscriber."""
        encoded = [base64.b64encode(each).decode() for each in data]
        self._send(do="send_bytes", topic=topic, type=message_type, data=encoded)

    def stop(self) -> None:
        """Stop the process, as a debugger does."""
        os.kill(self._process.pid, signal.SIGSTOP)

    def go_on(self) -> None:
        os.kill(self._process.pid, signal.SIGCONT)

    def received(self, topic: str, message_type: str = "", **qos: Any) -> list[Message]:
        """Return all messages since the first call for the topic, which must give its type."""
        if topic not in self._subscribed:
            self._subscribed.add(topic)
            self._send(do="subscribe", topic=topic, type=message_type, qos=qos)
        else:  # a message of a transient local publisher may have come: it is after the call, too
            self._take_in()
        return self._received.setdefault(topic, [])

    def next(self, topic: str, message_type: str = "", *, count: int = 1, **qos: Any) -> Message:
        """Return the count-th message after those received so far."""
        before = len(self.received(topic, message_type, **qos))
        wait_until(lambda: len(self.received(topic)) >= before + count, f"{topic}, {count} times")
        return self.received(topic)[before + count - 1]

    def wait_for(self, topic: str, message_type: str, holds: Callable[[Message], bool], what: str) -> Message:
        """Return the first message for which `holds` is true."""
        wait_until(lambda: any(holds(each) for each in self.received(topic, message_type)), what, 2 * DEADLINE)
        return next(each for each in self.received(topic) if holds(each))

    def call(self, service: str, service_type: str, **request: Any) -> Message:
        """Return the response of a service, once it is available."""
        return self._ask("response", do="call", service=service, type=service_type, request=request)

    def serve(self, service: str, service_type: str, **response: Any) -> None:
        """Answer each request of a service with this response; `requests` returns them."""
        self._send(do="serve", service=service, type=service_type, response=response)

    def send_goal(self, action: str, action_type: str, **goal: Any) -> bool:
        """Send a goal once the server is there; return whether it was accepted."""
        answer = self._ask("goal", do="send_goal", action=action, type=action_type, goal=goal)
        accepted: bool = answer["accepted"]
        return accepted

    def cancel_goal(self) -> Message:
        """Cancel the last goal; return the code of the answer and the number of goals that it cancels."""
        return self._ask("cancel", do="cancel")

    def result(self) -> Message:
        """Return status and result of the last goal, when it has ended."""
        self._wait_for("result", 1)
        return self._received["result"].pop()

    def act(self, action: str) -> None:
        """Serve test_msgs/action/Fibonacci."""
        self._send(do="act", action=action)

    def reported(self, label: str) -> list[Message]:
        """Return what was received on a topic or of "feedback" so far."""
        self._take_in()
        return self._received.setdefault(label, [])

    requests = reported  # of a service

    def graph(self) -> dict[str, Any]:
        """Return the topics, nodes and services that the peer knows."""
        return self._ask("graph", do="graph")

    def encode(self, message_type: str, message: Message) -> bytes:
        return base64.b64decode(self._ask("bytes", do="encode", type=message_type, message=message))

    def decode(self, message_type: str, data: bytes) -> Message:
        return self._ask("message", do="decode", type=message_type, data=base64.b64encode(data).decode())

    def recode(self, message_type: str, data: bytes) -> tuple[Message, bytes]:
        """Return the message that rclpy reads, and the bytes that it writes of it."""
        answer = self._ask("recoded", do="recode", type=message_type, data=base64.b64encode(data).decode())
        return answer["message"], base64.b64decode(answer["bytes"])

    def _ask(self, label: str, **command: Any) -> Any:
        self._take_in()
        number = len(self._received.setdefault(label, []))
        self._send(**command)
        self._wait_for(label, number + 1)
        return self._received[label][number]

    def _wait_for(self, label: str, count: int) -> None:
        def has_come() -> bool:
            self._take_in()
            assert self._process.poll() is None, f"the peer has ended, see {self._log}"
            return len(self._received.get(label, [])) >= count

        wait_until(has_come, label, 2 * DEADLINE)


@pytest.fixture
def ros2_peer(ros2_domain: Domain, tmp_path: Path) -> Iterator[Ros2Peer]:
    with Ros2Peer(ros2_domain, tmp_path / "peer.log") as peer:
        yield peer
