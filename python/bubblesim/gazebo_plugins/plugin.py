# SPDX-License-Identifier: BSD-3-Clause
"""Base class of the Gazebo plugins."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

from bubblesim import _core
from bubblesim._core.reading_messages import Clock, Header
from bubblesim.gazebo_plugins.parameters import Parameters
from bubblesim.gazebo_plugins.transforms import Transforms, is_needed
from bubblesim.messages.names import did_you_mean, nearest_names
from bubblesim.program.output import write_line

Message = dict[str, Any]
FASTEST = 1e6  # rad/s or m/s: limit of the physics


class FailedInSubstepError(RuntimeError):
    """What a plugin has in C++ failed in a physics substep, between two calls of the plugin."""


class StepTime:
    """The time stamp of all messages of plugins in a step: the end of the step. Wall time advances during the step."""

    def __init__(self, bridge: Any) -> None:
        """Read the time from this bridge."""
        self._bridge = bridge
        self.clock = Clock()

    def begin_step(self) -> None:
        """Set the stamp to the current time."""
        self.clock.set(*self._bridge.now())


@dataclass(frozen=True)
class PluginContext:
    """The object that has the plugin, and the interfaces that the plugin uses."""

    simulation: Any
    bridge: Any
    step_time: StepTime
    transforms: Transforms
    owner: int  # handle of the model or sensor that has the plugin; -1: the world
    model: int  # handle; -1: the world
    parameters: Parameters
    namespace: str | None  # of the spawn request; the plugin's namespace replaces it
    actuators: dict[int, Any]  # rotors and tracks of all plugins, by the handles of their joints and links
    need_rate: Callable[[float], None]  # makes the time step short enough to publish at a rate, Hz
    endpoints: list[Callable[[], None]] = field(default_factory=list)  # functions that shut them down

    def close(self) -> None:
        """Shut down the topics and services."""
        while self.endpoints:
            self.endpoints.pop()()


class Plugin:
    """A plugin of a model or world. ``actuate`` and ``publish`` are called in each step, ``close`` at its removal."""

    acts_without_ros = False  # whether it does its work, or a part of it, without a bridge
    of_world = False  # whether its <plugin> is in the <world>

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters; raise ParameterError if the plugin cannot work with them."""
        self.context = context
        self.parameters = context.parameters
        self.simulation = context.simulation
        self.world = context.simulation.world
        self.bridge = context.bridge
        self.namespace = ""
        self._warned = False
        self._headers: dict[str, Any] = {}  # by frame

    def actuate(self) -> None:
        """Command joints, before the physics."""

    def publish(self) -> None:
        """Publish the new state, after physics and sensors."""

    def reset(self) -> None:
        """Reset the state: called after a world reset, and once before the first step."""

    def close(self) -> None:
        """Release all resources."""
        self.context.close()

    def enter_namespace(self, *, of_model: bool = False) -> None:
        """Choose the namespace of topics and frames.

        That is <robotNamespace>; else the namespace of the spawn request; else the name of the model, or the root.
        """
        default = self.world.name(self.context.model) if of_model else ""
        given = self.parameters.given("robotNamespace")
        given = self.parameters.child("ros", "namespace") if given is None else given
        if given is None:
            namespace = default if self.context.namespace is None else self.context.namespace
        else:
            namespace = given or default
        self.namespace = namespace.strip("/")

    def topic(self, name: str) -> str:
        """Return the full name of a topic in the plugin's namespace."""
        parts = [name.strip("/")] if name.startswith("/") else [self.namespace, name.strip("/")]
        return "/" + "/".join(part for part in parts if part)

    def frame(self, name: str) -> str:
        """Return the full name of a frame, with the namespace as prefix, as in tf."""
        if name.startswith("/") or not self.namespace:
            return name.lstrip("/")
        return f"{self.namespace}/{name}"

    def advertise(self, topic: str, message_type: str, queue_size: int, *, latch: bool = False) -> int:
        """Advertise a topic until the plugin is closed; with `latch`, those who come later get the last message."""
        qos = _core.Qos(queue_size, transient_local=latch)
        publisher: int = self.bridge.advertise(self.topic(topic), message_type, qos)
        self.context.endpoints.append(lambda: self.bridge.shutdown_publisher(publisher))
        return publisher

    def subscribe(self, topic: str, message_type: str, callback: Callable[[Message], None]) -> None:
        """Subscribe until the plugin is closed; the callback gets the newest message of each step, none without ROS."""
        if self.bridge is None:
            return
        name = self.topic(topic)

        def deliver(message: Message) -> None:
            try:
                callback(message)
            except Exception as error:  # an error of one plugin must not end the others
                write_line(sys.stderr, f"error: {self.parameters.title} cannot process a message on {name}: {error}")

        subscriber = self.bridge.subscribe(name, message_type, deliver, 1, _core.messages.TimeForm.FLOAT)
        self.context.endpoints.append(lambda: self.bridge.shutdown_subscriber(subscriber))

    def subscribe_numbers(self, topic: str, message_type: str, fields: Sequence[str], target: Any) -> None:
        """Subscribe until the plugin is closed; ``target`` gets numbers of the newest message of each step.

        :param fields: such as ``linear.x``.
        :param target: a NumberTarget; what it cannot use is ignored with a warning.
        """
        if self.bridge is None:
            return
        what = message_type.rpartition("/")[2]
        arguments = self.topic(topic), message_type, fields, target, lambda numbers: self.usable(what, numbers), 1
        subscriber = self.bridge.subscribe_numbers(*arguments)
        self.context.endpoints.append(lambda: self.bridge.shutdown_subscriber(subscriber))

    def advertise_service(self, service: str, service_type: str, answer: Callable[[Message], Message | None]) -> None:
        """Advertise a service by its full name until the plugin is closed."""
        server = self.bridge.advertise_service(service, service_type, answer, _core.messages.TimeForm.FLOAT)
        self.context.endpoints.append(lambda: self.bridge.shutdown_service_server(server))

    def is_needed(self, publisher: int) -> bool:
        """Return whether the topic has subscribers or is recorded to a bag."""
        return is_needed(self.bridge, publisher)

    def header(self, frame: str) -> Any:
        """Return the Header of a message of this step, for the functions of ``_core.reading_messages``."""
        found = self._headers.get(frame)
        if found is None:
            found = self._headers[frame] = Header(self.context.step_time.clock, frame)
        return found

    def joint(self, parameter: str, default: str) -> int:
        """Return the handle of the joint named by a parameter."""
        return self.joint_named(self.parameters.text(parameter, default), parameter)

    def joint_named(self, name: str, parameter: str) -> int:
        """Return the handle of a joint of the model."""
        return self.part_named(name, parameter, "joint")

    def link(self, parameter: str, default: str) -> int:
        """Return the handle of the link named by a parameter, also as model::link."""
        return self.part_named(self.parameters.text(parameter, default).rpartition("::")[2], parameter, "link")

    def part_named(self, name: str, parameter: str, kind: str) -> int:
        """Return the handle of a link, joint or sensor of the model."""
        parts = {self.world.name(part): part for part in self.parts_of_model() if self.world.kind(part) == kind}
        if name in parts:
            return int(parts[name])
        model = self.world.path(self.context.model)
        hint = did_you_mean(nearest_names(name, sorted(parts)))
        raise self.parameters.fail(parameter, f"is '{name}', which is not a {kind} of {model}{hint}")

    def first_link(self) -> int:
        """Return the handle of the model's first link."""
        return next(part for part in self.parts_of_model() if self.world.kind(part) == "link")

    def parts_of_model(self) -> list[int]:
        """Return the handles of all parts of the model."""

        def below(handle: int) -> list[int]:
            return [each for child in self.world.children(handle) for each in (child, *below(child))]

        return below(self.context.model)

    def usable(self, what: str, numbers: Sequence[float]) -> bool:
        """Return whether numbers from a message are usable; warn the first time that they are not."""
        if all(math.isfinite(number) and abs(number) <= FASTEST for number in numbers):
            return True
        if not self._warned:
            self._warned = True
            found = ", ".join(f"{number:g}" for number in numbers)
            write_line(
                sys.stderr,
                f"warning: {self.parameters.title}: {what} ({found}) ignored: numbers must be finite and at "
                "most 1e6; further ones are ignored without a warning",
            )
        return False
