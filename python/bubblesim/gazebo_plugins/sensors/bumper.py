# SPDX-License-Identifier: BSD-3-Clause
"""gazebo_ros_bumper: contacts of a contact sensor's link."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from bubblesim._core import read_sensor
from bubblesim.gazebo_plugins.plugin import Message, Plugin, PluginContext
from bubblesim.gazebo_plugins.sensors.readings import NewReadings
from bubblesim.geometry.frames import into
from bubblesim.ros_messages import vector_message

_WORLD = ("/world", "world", "/map", "map")


class Bumper(Plugin):
    """Parameters and defaults are those of gazebo_ros_pkgs; positions and forces are in the frame of a link."""

    def __init__(self, context: PluginContext) -> None:
        """Read the parameters."""
        super().__init__(context)
        p = self.parameters
        self.enter_namespace()
        self._frame = p.text("frameName", "world")
        self._reference = None if self._frame in _WORLD else self.link("frameName", "")
        self._readings = NewReadings(self, lambda *sensor: read_sensor(*sensor)[1], p.number("updateRate", 0.0))
        p.check()
        self._publisher = self.advertise(p.text("bumperTopicName", "bumper_states"), "gazebo_msgs/ContactsState", 1)

    def reset(self) -> None:
        """Reset the state."""
        self._readings.reset()

    def publish(self) -> None:
        """Publish the contacts, also if there are none."""
        if self.is_needed(self._publisher) and (reading := self._readings.take()):
            link = self.world.parent(self.context.owner)
            states = [contact_state(self.world, link, each, self._turned, self._placed) for each in reading.contacts]
            self.bridge.publish(self._publisher, {"header": self.header(self._frame.lstrip("/")), "states": states})

    def _turned(self, vector: Sequence[float]) -> Sequence[float]:
        return vector if self._reference is None else into(self.world.pose(self._reference), vector)

    def _placed(self, position: Sequence[float]) -> Sequence[float]:
        if self._reference is None:
            return position
        origin = self.world.pose(self._reference)[:3]
        return self._turned([at - start for at, start in zip(position, origin, strict=True)])


def contact_state(
    world: Any,
    link: int,
    contact: Any,
    turned: Callable[[Sequence[float]], Sequence[float]] = list,
    placed: Callable[[Sequence[float]], Sequence[float]] = list,
) -> Message:
    """Return a gazebo_msgs/ContactState of a link, in world axes or those of ``turned`` and ``placed``."""
    forces = [turned(point.force.tolist()) for point in contact.points]
    total = [sum(along) for along in zip(*forces, strict=True)] if forces else [0.0, 0.0, 0.0]
    own = f"{_scoped(world, link)}::{contact.collision}"
    other = f"{_scoped(world, contact.other)}::{contact.other_collision}"
    return {
        "info": f"{own} touches {other}",
        "collision1_name": own,
        "collision2_name": other,
        "wrenches": [{"force": vector_message(force)} for force in forces],
        "total_wrench": {"force": vector_message(total)},
        "contact_positions": [vector_message(placed(point.position.tolist())) for point in contact.points],
        "contact_normals": [vector_message(turned(point.normal.tolist())) for point in contact.points],
        "depths": [point.depth for point in contact.points],
    }


def _scoped(world: Any, link: int) -> str:
    return f"{world.name(world.model_of(link))}::{world.name(link)}"
