# SPDX-License-Identifier: BSD-3-Clause
"""What a device is: the part of a robot that a plugin of Gazebo stands for, seen from ROS."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

from bubblesim import _core
from bubblesim.gazebo_plugins.parameters import Parameters
from bubblesim.gazebo_plugins.transforms import Transforms, wanted
from bubblesim.messages.names import did_you_mean, nearest_names
from bubblesim.output import write_line

Message = dict[str, Any]
FASTEST = 1e6  # rad/s or m/s: what the physics takes


class StepTime:
    """The time that all messages of a step carry, also where ROS's goes on meanwhile."""

    def __init__(self, bridge: Any) -> None:
        """Take it from this bridge."""
        self._bridge = bridge
        self.stamp: Message = {}

    def begin_step(self) -> None:
        """Take it anew."""
        secs, nsecs = self._bridge.now()
        self.stamp = {"secs": secs, "nsecs": nsecs}


@dataclass(frozen=True)
class PluginContext:
    """Where a device is, and what it is made of."""

    simulation: Any
    bridge: Any
    step_time: StepTime
    transforms: Transforms
    owner: int  # handle of the model or sensor that has the plugin
    model: int  # handle
    parameters: Parameters
    namespace: str | None  # of a model that was spawned into one, which a plugin's own replaces
    endpoints: list[Callable[[], None]] = field(default_factory=list)  # what takes them down

    def close(self) -> None:
        """Take down the topics."""
        while self.endpoints:
            self.endpoints.pop()()


class Device:
    """Made for one plugin of a model. Its phases are called once a step, and ``close`` when its model goes."""

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters; ParameterError for those with which the device cannot work."""
        self.context = context
        self.parameters = context.parameters
        self.simulation = context.simulation
        self.world = context.simulation.world
        self.bridge = context.bridge
        self.namespace = ""
        self._told = False

    def actuate(self) -> None:
        """Command joints, before the physics."""

    def publish(self) -> None:
        """Tell what is now, after physics and sensors."""

    def reset(self) -> None:
        """The world was put back to its start; before this, once when the device begins."""

    def close(self) -> None:
        """Let go of everything outside."""
        self.context.close()

    def enter_namespace(self, *, of_model: bool = False) -> None:
        """Choose where topics and frames are.

        That is <robotNamespace>; without one where the model was spawned; else the name of the model, or the root.
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
        """The full name of a topic in the device's namespace."""
        parts = [name.strip("/")] if name.startswith("/") else [self.namespace, name.strip("/")]
        return "/" + "/".join(part for part in parts if part)

    def frame(self, name: str) -> str:
        """The full name of a frame, which has the namespace for a prefix, as in tf."""
        if name.startswith("/") or not self.namespace:
            return name.lstrip("/")
        return f"{self.namespace}/{name}"

    def advertise(self, topic: str, message_type: str, queue_size: int) -> int:
        """Advertise a topic until the device is closed."""
        publisher: int = self.bridge.advertise(self.topic(topic), message_type, queue_size, False)
        self.context.endpoints.append(lambda: self.bridge.shutdown_publisher(publisher))
        return publisher

    def subscribe(self, topic: str, message_type: str, callback: Callable[[Message], None]) -> None:
        """Have the newest message of each step handed over until the device is closed."""
        name = self.topic(topic)

        def deliver(message: Message) -> None:
            try:
                callback(message)
            except Exception as error:  # one device must not end the others
                write_line(sys.stderr, f"error: {self.parameters.title} cannot take a message on {name}: {error}")

        subscriber = self.bridge.subscribe(name, message_type, deliver, 1, _core.messages.TimeForm.FLOAT)
        self.context.endpoints.append(lambda: self.bridge.shutdown_subscriber(subscriber))

    def advertise_service(self, service: str, service_type: str, answer: Callable[[Message], Message | None]) -> None:
        """Offer a service of a full name until the device is closed."""
        server = self.bridge.advertise_service(service, service_type, answer, _core.messages.TimeForm.FLOAT)
        self.context.endpoints.append(lambda: self.bridge.shutdown_service_server(server))

    def wanted(self, publisher: int) -> bool:
        """Whether somebody listens, or a bag keeps all."""
        return wanted(self.bridge, publisher)

    def header(self, frame: str) -> Message:
        """A std_msgs/Header of this step."""
        return {"stamp": self.context.step_time.stamp, "frame_id": frame}

    def joint(self, parameter: str, default: str) -> int:
        """The handle of the joint that a parameter names."""
        return self.joint_named(self.parameters.text(parameter, default), parameter)

    def joint_named(self, name: str, parameter: str) -> int:
        """The handle of one of the model's joints."""
        return self.part_named(name, parameter, "joint")

    def link(self, parameter: str, default: str) -> int:
        """The handle of the link that a parameter names, also as model::link."""
        return self.part_named(self.parameters.text(parameter, default).rpartition("::")[2], parameter, "link")

    def part_named(self, name: str, parameter: str, kind: str) -> int:
        """The handle of one of the model's links, joints or sensors."""
        parts = {self.world.name(part): part for part in self.parts_of_model() if self.world.kind(part) == kind}
        if name in parts:
            return int(parts[name])
        model = self.world.path(self.context.model)
        hint = did_you_mean(nearest_names(name, sorted(parts)))
        raise self.parameters.fail(parameter, f"names no {kind} of {model}: it has no '{name}'{hint}")

    def first_link(self) -> int:
        """The handle of the model's first link."""
        return next(part for part in self.parts_of_model() if self.world.kind(part) == "link")

    def parts_of_model(self) -> list[int]:
        """The handles of all that belongs to the model."""

        def below(handle: int) -> list[int]:
            return [each for child in self.world.children(handle) for each in (child, *below(child))]

        return below(self.context.model)

    def usable(self, what: str, numbers: Sequence[float]) -> bool:
        """Whether numbers from a message are usable; when they are not for the first time, a line says so."""
        if all(math.isfinite(number) and abs(number) <= FASTEST for number in numbers):
            return True
        if not self._told:
            self._told = True
            found = ", ".join(f"{number:g}" for number in numbers)
            write_line(
                sys.stderr,
                f"warning: {self.parameters.title}: a {what} of {found} is left out: numbers must be finite and at "
                "most 1e6; further ones are left out without a word",
            )
        return False
