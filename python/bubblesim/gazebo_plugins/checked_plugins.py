# SPDX-License-Identifier: BSD-3-Clause
"""The plugins and topics of a scene, made as in the node but without ROS, to find what is wrong with them."""

from __future__ import annotations

import re
from typing import Any

from bubblesim.gazebo_plugins.control.ros_control import RosControl
from bubblesim.gazebo_plugins.plugin import Plugin
from bubblesim.gazebo_plugins.robots import GazeboPlugins

_NOT_IN_NAMES = re.compile(r"[^A-Za-z0-9_/]")


class CheckedPlugins(GazeboPlugins):
    """Warnings are written to stderr, as by the node."""

    def __init__(self, simulation: Any) -> None:
        """Make the plugins of the models of a simulation."""
        self.problems: list[str] = []  # for which the node leaves out a plugin or a topic
        self._hints = 0
        super().__init__(simulation, _CheckingBridge())

    @property
    def warnings(self) -> int:
        """The number of warnings that were written."""
        return self._unknown.warned + self._hints

    def _make(self, kind: type[Plugin], description: Any, owner: int, model: int, namespace: str | None) -> None:
        if not issubclass(kind, RosControl):  # it reads parameters of a ROS master
            super()._make(kind, description, owner, model, namespace)

    def _left_out(self, problem: str) -> None:
        self.problems += problem.splitlines()

    def _hint(self, text: str) -> None:
        super()._hint(text)
        self._hints += 1


class _CheckingBridge:
    """Has the functions of a bridge that plugins call; it checks the names of topics and services."""

    def advertise(self, topic: str, message_type: str, qos: Any) -> int:
        return self._checked("topic", topic)

    def subscribe(self, topic: str, message_type: str, callback: Any, qos: Any, time: Any) -> int:
        return self._checked("topic", topic)

    def subscribe_numbers(self, topic: str, message_type: str, fields: Any, target: Any, refused: Any, qos: Any) -> int:
        return self._checked("topic", topic)

    def advertise_service(self, name: str, service_type: str, callback: Any, time: Any) -> int:
        return self._checked("service", name)

    def shutdown_publisher(self, publisher: int) -> None:
        pass

    def shutdown_subscriber(self, subscriber: int) -> None:
        pass

    def shutdown_service_server(self, server: int) -> None:
        pass

    def _checked(self, kind: str, name: str) -> int:
        wrong = _NOT_IN_NAMES.search(name)
        if wrong:
            raise ValueError(f"invalid {kind} name '{name}': it has '{wrong[0]}'; use letters, digits, _ and /")
        return 0
