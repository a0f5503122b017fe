# SPDX-License-Identifier: BSD-3-Clause
"""ROS topics for pages: velocities and numbers. The server is a node of its own while a page uses them."""

from __future__ import annotations

import asyncio
import contextlib
import functools
import threading
import time
from collections import deque
from collections.abc import Mapping
from typing import Any

from bubblesim.controllers.base_velocity import STANDING, BaseVelocity
from bubblesim.program.addresses import master_uri
from bubblesim.program.ros_calls import RosCallError, call
from bubblesim.services.simulation_topics import CONTROLS
from bubblesim.web.threads import in_thread

_lock = threading.Lock()
_ROS_TYPES = {"geometry_msgs/Twist", "geometry_msgs/TwistStamped"}
_NUMERIC = {
    *(f"{kind}{bits}" for kind in ("int", "uint") for bits in (8, 16, 32, 64)),
    *("float32", "float64", "bool", "byte", "char", "time", "duration"),
}
_COMMON = {"/clock", "/diagnostics", "/rosout", "/rosout_agg", "/tf", "/tf_static", *CONTROLS}  # of no robot
_MOST_FIELDS = 400
_MOST_SAMPLES = 5000
_MOST_WATCHED = 64
_SILENCE = 0.4  # s without a command, after which a robot is stopped
_RECENT = 1.0  # s after which a message has been sent, even on a busy machine
_DEEPEST = 6


class NoRosError(RuntimeError):
    """There is no ROS master, or no rospy."""


@functools.cache
def _started() -> Any:
    import rospy

    # Without /rosout: a read-only page makes this a node, too, and must not publish.
    rospy.init_node("bubblesim_window", anonymous=True, disable_signals=True, disable_rosout=True)
    return rospy


def node() -> Any:
    """Return rospy, with the node of the server; raise NoRosError. It may take a second the first time."""
    try:
        import rosgraph
    except ImportError as error:
        raise NoRosError(f"ROS is not installed for {error.name}") from None
    with _lock:
        if not rosgraph.is_master_online():
            raise NoRosError("no ROS master is running, or the simulator runs without ROS (--no-ros)")
        return _started()


async def topics(_page: Any) -> list[list[str]]:
    """Return names and types of all published topics, and of those that nodes listen to for velocities."""

    def ask() -> list[list[str]]:
        known: dict[str, str] = dict(node().get_published_topics())
        known |= _types_of({topic: nodes for topic, nodes in _listeners().items() if topic not in known})
        return sorted([name, kind] for name, kind in known.items() if kind != "*")

    return await in_thread(ask)


async def subscribed(_page: Any) -> list[list[str]]:
    """Return names and types of the topics on which other nodes listen to commands."""

    def ask() -> list[list[str]]:
        listeners = {topic: nodes for topic, nodes in _listeners().items() if topic not in _COMMON}
        return sorted([name, kind] for name, kind in _types_of(listeners).items())

    return await in_thread(ask)


def _listeners() -> dict[str, set[str]]:
    """Return the other nodes that listen to each topic."""
    own = node().get_name()
    subscribers = call(master_uri(), own, "getSystemState")[1]
    return {topic: others for topic, nodes in subscribers if (others := set(nodes) - {own})}


def _types_of(listeners: Mapping[str, set[str]]) -> dict[str, str]:
    """Return the types that listeners expect of their topics, by topic; "*" where they take any.

    The nodes are asked: the master keeps the type that a topic had last, also that of a node that has ended.
    """
    own = node().get_name()
    types: dict[str, str] = dict.fromkeys(listeners, "*")
    for name in set().union(*listeners.values()):
        with contextlib.suppress(RosCallError):  # it has ended
            subscribed = call(call(master_uri(), own, "lookupNode", name), own, "getSubscriptions")
            types |= {topic: kind for topic, kind in subscribed if types.get(topic) == "*"}
    return types


async def fields(_page: Any, topic: str) -> list[str]:
    """Return the paths of the numeric fields of a topic, such as 'twist.linear.x' or 'ranges[0]'."""

    def ask() -> list[str]:
        return list(_paths(_class_of(topic), ""))[:_MOST_FIELDS]

    return await in_thread(ask)


def _class_of(topic: str) -> Any:
    import rostopic

    node()
    found, _, _ = rostopic.get_topic_class(topic)
    if found is None:
        raise ValueError(f"the type of the topic {topic} is not known: no node publishes it")
    return found


def _paths(message: Any, before: str, depth: int = 0) -> Any:
    import roslib.message

    for name, kind in zip(message.__slots__, message._slot_types, strict=True):
        plain, is_array, _ = kind.partition("[")
        path = f"{before}{name}{'[0]' if is_array else ''}"
        if plain in _NUMERIC:
            yield path
        elif "/" in plain and depth < _DEEPEST:
            yield from _paths(roslib.message.get_message_class(plain), f"{path}.", depth + 1)


class Watch:
    """Values of one field of a topic."""

    def __init__(self, topic: str, path: str) -> None:
        """Subscribe."""
        self._steps = path.replace("[", ".[").split(".")
        self._samples: deque[tuple[int, float, float]] = deque(maxlen=_MOST_SAMPLES)
        self._count = 0
        rospy = node()
        self._rospy = rospy
        self._subscriber = rospy.Subscriber(topic, _class_of(topic), self._receive, queue_size=100)

    def _receive(self, message: Any) -> None:
        value = message
        try:
            for step in self._steps:
                value = value[int(step[1:-1])] if step.startswith("[") else getattr(value, step)
        except (AttributeError, IndexError, ValueError):
            return
        header = getattr(message, "header", None)
        stamp = header.stamp.to_sec() if header is not None else 0.0
        number = value.to_sec() if hasattr(value, "to_sec") else float(value)
        self._count += 1
        self._samples.append((self._count, stamp or self._rospy.get_time(), number))

    def since(self, number: int) -> dict[str, Any]:
        """Return the samples after a number: times, s of ROS time, and values."""
        new = [sample for sample in list(self._samples) if sample[0] > number]
        return {"last": self._count, "times": [t for _, t, _ in new], "values": [v for _, _, v in new]}

    def close(self) -> None:
        """Unsubscribe."""
        self._subscriber.unregister()


class Driver:
    """Publishes the velocities of one page, and zero when the page is silent, so that the robot stops."""

    def __init__(self, topic: str) -> None:
        """Advertise the topic, with the type that its listeners have, else geometry_msgs/Twist."""
        from geometry_msgs.msg import Twist, TwistStamped

        rospy = node()
        kind = _types_of({topic: _listeners().get(topic, set())})[topic]
        if kind not in (*_ROS_TYPES, "*"):
            raise ValueError(f"{topic} has the type {kind}; velocities are geometry_msgs/Twist or TwistStamped")
        self.topic = topic
        self._stamped = kind.endswith("Stamped")
        self._publisher = rospy.Publisher(topic, TwistStamped if self._stamped else Twist, queue_size=1)
        self._moving = False
        self._last = 0.0

    def send(self, velocity: BaseVelocity) -> None:
        """Publish a velocity."""
        self._publisher.publish(self._message(velocity))
        self._moving = velocity != STANDING
        self._last = time.monotonic()

    def _message(self, velocity: BaseVelocity) -> Any:
        from bubblesim.nodes.twist_commands import velocity_message

        return velocity_message(velocity, stamped=self._stamped)

    def stop_if_silent(self) -> None:
        """Stop the robot if the last command is too old."""
        if self._moving and time.monotonic() - self._last > _SILENCE:
            self.send(STANDING)

    def close(self) -> None:
        """Stop the robot, and end publishing. It waits: a message is lost if its topic ends too early."""
        from bubblesim.nodes.last_message import send_last

        if self._moving or time.monotonic() - self._last < _RECENT:
            send_last((self._publisher, self._message(STANDING)))
        self._publisher.unregister()


class PageTopics:
    """What one page subscribes and publishes.

    Functions of ROS wait for other processes, so they run in threads. Each thread notes what it has made: then
    ``close`` finds it, also if the page has closed meanwhile.
    """

    def __init__(self) -> None:
        """Create it without topics."""
        self._watches: dict[int, Watch] = {}
        self._created = 0
        self._driver: Driver | None = None
        self._driving = asyncio.Lock()  # commands are sent in their order, also while the first makes the publisher
        self._guard: asyncio.Task[None] | None = None

    async def watch(self, topic: str, path: str) -> int:
        """Subscribe to a field of a topic; return the number of the watch."""
        if len(self._watches) >= _MOST_WATCHED:
            raise ValueError(f"a page can plot at most {_MOST_WATCHED} fields of topics")
        self._created += 1
        number = self._created
        await in_thread(self._begin_watch, number, topic, path)
        return number

    def _begin_watch(self, number: int, topic: str, path: str) -> None:
        self._watches[number] = Watch(topic, path)

    def samples(self, number: int, since: int) -> dict[str, Any]:
        """Return the samples of a watch; see Watch.since."""
        return self._watches[number].since(since)

    async def unwatch(self, number: int) -> None:
        """End a watch."""
        found = self._watches.pop(number, None)
        if found is not None:
            await in_thread(found.close)

    async def drive(self, topic: str, velocity: BaseVelocity) -> None:
        """Publish a velocity; without another one within 0.4 s, zero follows."""
        async with self._driving:
            driver = self._driver
            if driver is None or driver.topic != topic:
                driver = await in_thread(self._begin_driving, topic)
            driver.send(velocity)
        if self._guard is None:
            self._guard = asyncio.get_running_loop().create_task(self._watch_silence())

    def _begin_driving(self, topic: str) -> Driver:
        self._end_driving()
        self._driver = Driver(topic)
        return self._driver

    def _end_driving(self) -> None:
        driver, self._driver = self._driver, None
        if driver is not None:
            driver.close()

    async def _watch_silence(self) -> None:
        while self._driver is not None:
            await asyncio.sleep(_SILENCE / 4)
            if self._driver is not None:
                self._driver.stop_if_silent()
        self._guard = None

    async def close(self) -> None:
        """Stop the robot, and end all subscriptions."""
        await in_thread(self._end)
        if self._guard is not None:
            self._guard.cancel()

    def _end(self) -> None:
        self._end_driving()
        for each in self._watches.values():
            each.close()
        self._watches.clear()
