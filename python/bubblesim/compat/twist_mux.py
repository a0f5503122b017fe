# SPDX-License-Identifier: BSD-3-Clause
"""The node twist_mux: passes on the velocity command of the highest priority."""

from __future__ import annotations

import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import rospy
from geometry_msgs.msg import Twist
from std_msgs.msg import Bool

from bubblesim.nodes.run_node import run_node


@dataclass
class Source:
    """An input: a topic of commands, or of a lock, which holds back commands of lower priority."""

    name: str
    topic: str
    priority: int
    timeout: float  # s after which a message does not count any more; 0: never
    time: float = -1e9  # s, of the last message
    locked: bool = False  # of a lock

    def is_current(self, now: float) -> bool:
        """Return whether the last message counts."""
        return self.timeout <= 0.0 or now - self.time < self.timeout


@dataclass
class Choice:
    """Selects the commands that are passed on, without ROS."""

    commands: Sequence[Source]
    locks: Sequence[Source]

    def lock_priority(self, now: float) -> int:
        """Return the priority up to which commands are held back; a lock that is silent for too long locks."""
        closed = [lock for lock in self.locks if lock.locked or not lock.is_current(now)]
        return max((lock.priority for lock in closed), default=0)

    def passes(self, source: Source, now: float) -> bool:
        """Return whether a command that comes from this source now is passed on."""
        source.time = now
        others = [
            each.priority for each in self.commands if each is not source and each.time > 0 and each.is_current(now)
        ]
        return source.priority >= max(self.lock_priority(now), *others, 0) and source.priority > 0


def sources(parameter: str) -> list[Source]:
    """Read the inputs of a parameter, a list of dictionaries.

    :raises ValueError: if one lacks a topic.
    """
    found = []
    for entry in rospy.get_param(parameter, []):
        if not isinstance(entry, dict) or "topic" not in entry:
            raise ValueError(f"{parameter} must be a list of name, topic, timeout and priority; found {entry}")
        name = str(entry.get("name", entry["topic"]))
        priority, timeout = int(entry.get("priority", 0)), float(entry.get("timeout", 0.0))
        found.append(Source(name, str(entry["topic"]), priority, timeout))
    return found


class TwistMux:
    """Subscribes to the topics of the parameters, and publishes cmd_vel_out."""

    def __init__(self) -> None:
        """Read the parameters ~topics and ~locks."""
        self._choice = Choice(sources("~topics"), sources("~locks"))
        self._output = rospy.Publisher("cmd_vel_out", Twist, queue_size=1)
        for source in self._choice.commands:
            rospy.Subscriber(source.topic, Twist, self._on_command, source, queue_size=1)
        for lock in self._choice.locks:
            rospy.Subscriber(lock.topic, Bool, self._on_lock, lock, queue_size=1)

    def _on_command(self, message: Any, source: Source) -> None:
        if self._choice.passes(source, time.monotonic()):
            self._output.publish(message)

    def _on_lock(self, message: Any, lock: Source) -> None:
        lock.locked = message.data
        lock.time = time.monotonic()


def main() -> int:
    """Run the node until shutdown; return 2 for invalid parameters."""
    return run_node("twist_mux", sys.modules[__name__].__doc__, TwistMux)
