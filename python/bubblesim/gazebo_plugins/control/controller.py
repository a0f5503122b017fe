# SPDX-License-Identifier: BSD-3-Clause
"""Base class of controllers: the topics and parameters around a controller of ``bubblesim._core.control``."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

from bubblesim import _core
from bubblesim._core.control import CommandInterface, PidGains
from bubblesim.gazebo_plugins.control.ros_parameters import ControllerError, ControllerParameters
from bubblesim.gazebo_plugins.plugin import Message, Plugin
from bubblesim.gazebo_plugins.rate import Rate
from bubblesim.messages.names import did_you_mean, nearest_names
from bubblesim.program.output import write_line

INTERFACES = {
    "position": CommandInterface.POSITION,
    "velocity": CommandInterface.VELOCITY,
    "effort": CommandInterface.EFFORT,
}


def interface_name(kind: str) -> str:
    """Return hardware_interface/EffortJointInterface for "effort"."""
    return f"hardware_interface/{kind.capitalize()}JointInterface"


@dataclass(frozen=True)
class Joint:
    """A joint of the robot that controllers may use."""

    index: int  # among the manager's joints
    handle: int
    kinds: Sequence[str]  # "position", "velocity" or "effort", of its transmissions
    initial_position: float | None = None  # rad or m; None: that of the model


@dataclass(frozen=True)
class Robot:
    """What controllers share."""

    plugin: Plugin
    manager: Any  # bubblesim._core.control.ControllerManager
    joints: dict[str, Joint]
    namespace: str  # of the controller manager: "/" or "/robot"
    used_kinds: dict[str, str] = field(default_factory=dict)  # the interface that is in use, by joint

    def stamp(self) -> float:
        """Return the time of the state, for the headers of messages, s."""
        seconds, nanoseconds = self.plugin.bridge.now()
        return float(seconds + nanoseconds * 1e-9)


class Controller:
    """A controller that is loaded. Subclasses read their parameters, make ``core`` and publish."""

    def __init__(self, robot: Robot, name: str, parameters: ControllerParameters) -> None:
        """:param name: relative to the namespace of the controller manager."""
        self.robot = robot
        self.name = name
        self.parameters = parameters
        self.type = parameters.text("type")
        self.state = "initialized"
        self.claimed: dict[str, list[str]] = {}  # names of joints, by their interface
        self.core: Any = None  # of bubblesim._core.control; None for one that commands nothing
        self._endpoints: list[Callable[[], None]] = []

    def start(self) -> None:
        """Start it, with its interfaces; raise ValueError if another one has its joints."""
        if self.core is not None:
            for kind, names in self.claimed.items():
                for name in names:
                    if self.robot.used_kinds.get(name) != kind:
                        joint = self.robot.joints[name]
                        self.robot.manager.set_interface(joint.index, INTERFACES[kind])
                        self.robot.used_kinds[name] = kind
            self.core.start(self.robot.manager)
        self.state = "running"

    def stop(self) -> None:
        """Stop it."""
        if self.core is not None:
            self.core.stop(self.robot.manager)
        self.state = "stopped"

    def publish(self) -> None:
        """Publish after a step, while it runs."""

    def reset(self) -> None:
        """Start again after a reset of the world."""

    def close(self) -> None:
        """Shut down the topics."""
        while self._endpoints:
            self._endpoints.pop()()

    def claim(self, kind: str, names: Sequence[str]) -> list[int]:
        """Note the joints that are commanded by an interface; return their indices.

        :raises ControllerError: for unknown joints, and those without this interface.
        """
        indices = []
        for name in names:
            joint = self.robot.joints.get(name)
            if joint is None:
                hint = did_you_mean(nearest_names(name, sorted(self.robot.joints)))
                raise ControllerError(
                    f"{self.parameters.name}: the robot has no joint '{name}' with a <transmission>{hint}"
                )
            if kind not in joint.kinds:
                has = ", ".join(map(interface_name, joint.kinds)) or "none"
                raise ControllerError(
                    f"{self.parameters.name}: '{name}' has no {interface_name(kind)}; its <transmission> has {has}"
                )
            indices.append(joint.index)
            self.claimed.setdefault(kind, []).append(name)
        return indices

    def topic(self, name: str) -> str:
        """Return the full name of a topic of the controller."""
        return f"{self.robot.namespace.rstrip('/')}/{self.name}/{name}"

    def advertise(self, topic: str, message_type: str, queue_size: int = 10) -> int:
        """Advertise a topic by its full name."""
        bridge = self.robot.plugin.bridge
        publisher: int = bridge.advertise(topic, message_type, queue_size)
        self._endpoints.append(lambda: bridge.shutdown_publisher(publisher))
        return publisher

    def subscribe(self, name: str, message_type: str, callback: Callable[[Message], None]) -> None:
        """Call a function with the newest message of each step on a topic of the controller, while it runs."""
        bridge = self.robot.plugin.bridge

        def deliver(message: Message) -> None:
            if self.state != "running":
                return
            try:
                callback(message)
            except ValueError as error:
                self.warn(f"a message on {self.topic(name)} is ignored: {error}")

        subscriber = bridge.subscribe(self.topic(name), message_type, deliver, 1, _core.messages.TimeForm.FLOAT)
        self._endpoints.append(lambda: bridge.shutdown_subscriber(subscriber))

    def subscribe_numbers(self, name: str, message_type: str, fields: Sequence[str], target: Any) -> None:
        """Give numbers of messages to a NumberTarget."""
        plugin = self.robot.plugin
        what = message_type.rpartition("/")[2]
        arguments = self.topic(name), message_type, fields, target, lambda numbers: plugin.usable(what, numbers), 1
        subscriber = plugin.bridge.subscribe_numbers(*arguments)
        self._endpoints.append(lambda: plugin.bridge.shutdown_subscriber(subscriber))

    def rate(self, key: str, default: float | None) -> Rate:
        """Return the rate of a parameter, which the simulation step is fitted to."""
        hertz = self.parameters.length(key, default)
        self.robot.plugin.context.need_rate(hertz)
        return Rate(hertz, self.robot.plugin.simulation)

    def is_needed(self, publisher: int) -> bool:
        """Return whether a topic has subscribers or is recorded."""
        return self.robot.plugin.is_needed(publisher)

    def send(self, publisher: int, message: Message) -> None:
        """Publish a message."""
        self.robot.plugin.bridge.publish(publisher, message)

    def warn(self, text: str) -> None:
        """Write a warning to the log."""
        write_line(sys.stderr, f"warning: controller {self.name}: {text}")


def read_gains(parameters: ControllerParameters) -> PidGains:
    """Read the gains of a PID controller; raise ControllerError if there are none."""
    clamp = abs(parameters.number("i_clamp", 0.0))
    most, least = parameters.number("i_clamp_max", clamp), parameters.number("i_clamp_min", -clamp)
    if not any(parameters.has(key) for key in "pid"):
        raise ControllerError(f"parameter {parameters.name}: the gains p, i and d are missing")
    p, i, d = (parameters.number(key, 0.0) for key in "pid")
    return PidGains(p, i, d, most, least, parameters.flag("antiwindup", default=False))
