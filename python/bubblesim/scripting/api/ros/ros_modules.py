# SPDX-License-Identifier: BSD-3-Clause
"""The modules `simROS` and `simROS2` of one child script: two sets of names, on the same bridge or on two."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from bubblesim import _core
from bubblesim.scripting.api.differences import differs
from bubblesim.scripting.api.functions import script_module
from bubblesim.scripting.api.ros.actions import RosActions
from bubblesim.scripting.api.ros.images import RosImages
from bubblesim.scripting.api.ros.kinds import CallbackOrName, QueueSize, RosHandle, Seconds, Stamp
from bubblesim.scripting.api.ros.parameters import RosParameters
from bubblesim.scripting.api.ros.qos import read_qos
from bubblesim.scripting.api.ros.services import RosServices
from bubblesim.scripting.api.ros.stamps import now
from bubblesim.scripting.api.ros.transforms import RosTransforms
from bubblesim.scripting.api.ros.transport import read_transport_hints

_PART_OF_ACTION = re.compile(r"(?P<package>\w+)/action/(?P<action>\w+)(?P<part>Goal|Result|Feedback)")
_HALF_OF_SERVICE = re.compile(r"(?P<service>\w+/srv/\w+?)_?(?P<half>Request|Response)")


@script_module("simROS")
class SimRos(RosServices, RosTransforms, RosImages, RosParameters):
    """`simROS`: times in messages are float seconds."""

    def advertise(self, topic: str, message_type: str, queue_size: QueueSize = 1, latch: bool = False) -> int:
        """Create a publisher and return its handle."""
        return self._advertise(topic, message_type, _core.Qos(queue_size, transient_local=latch))

    @differs("transport hints may choose UDP; here messages are sent over TCP")
    def subscribe(
        self,
        topic: str,
        message_type: str,
        callback: CallbackOrName,
        queue_size: QueueSize = 1,
        transport_hints: Mapping[str, Any] | None = None,
    ) -> int:
        """Create a subscriber and return its handle; ``callback`` (a function or its name) gets each message as a dict.

        ``transport_hints`` can have 'tcpNoDelay' (default True), 'transports' (a list of 'reliable' or 'tcp',
        'unreliable' or 'udp') and 'maxDatagramSize'. The last two have no effect: messages are always sent over TCP.
        The hints of the first subscriber of a topic apply to all.
        """
        hints = read_transport_hints(transport_hints)
        if hints.wants_udp:
            self._warn(f"'{topic}' is subscribed over TCP: UDP is not supported")
        guarded = self._caller.callback(callback)
        qos = _core.Qos(queue_size, tcp_no_delay=hints.tcp_no_delay)
        return self._subscribe(topic, message_type, guarded, qos, for_script=True)

    def shutdownSubscriber(self, subscriber: RosHandle) -> None:
        """Shut down a subscriber; its handle becomes invalid."""
        self._shutdown_subscriber(subscriber)

    def serviceClient(self, name: str, service_type: str) -> int:
        """Create a service client and return its handle."""
        return self._client(name, service_type)

    def advertiseService(self, name: str, service_type: str, callback: CallbackOrName) -> int:
        """Advertise a service and return its handle; ``callback`` gets a request as a dict and returns the response."""
        return self._server(name, service_type, callback)

    def shutdownServiceClient(self, client: RosHandle) -> None:
        """Shut down a service client; its handle becomes invalid."""
        self._shutdown_client(client)

    def shutdownServiceServer(self, server: RosHandle) -> None:
        """Shut down a service server; its handle becomes invalid."""
        self._shutdown_server(server)

    def serviceClientTreatUInt8ArrayAsString(self, client: RosHandle) -> None:
        """Let uint8[] of responses be strings in Lua, not tables; in Python they are always bytes."""
        self._byte_arrays.deliver_strings(client)

    def serviceServerTreatUInt8ArrayAsString(self, server: RosHandle) -> None:
        """Let uint8[] of requests be strings in Lua, not tables; in Python they are always bytes."""
        self._byte_arrays.deliver_strings(server)

    def imageTransportAdvertise(self, topic: str, queue_size: QueueSize = 1) -> int:
        """Create a publisher of images on ``topic``, and compressed on ``topic``/compressed; return its handle."""
        return self._advertise_images(topic, queue_size)

    def imageTransportSubscribe(
        self, topic: str, callback: CallbackOrName, queue_size: QueueSize = 1, transport: str = "raw"
    ) -> int:
        """Create a subscriber of images and return its handle; ``callback`` gets (data, width, height).

        ``transport`` is 'raw', or 'compressed' for ``topic``/compressed. An invalid image is ignored with a warning.
        """
        return self._subscribe_images(topic, callback, queue_size, transport)

    def imageTransportShutdownSubscriber(self, subscriber: RosHandle) -> None:
        """Shut down a subscriber of images; its handle becomes invalid."""
        self._shutdown_subscriber(subscriber)

    def getTime(self, flag: int = 0) -> float:
        """Return ROS time in seconds, for stamps: with /use_sim_time the time of the state, else wall time.

        The time of the state is the simulated time, and in sysCall_sensing the end of the step.
        """
        sec, nanosec = self._bridge.now()
        return float(sec + nanosec * 1e-9)


@script_module("simROS2")
class SimRos2(RosServices, RosTransforms, RosImages, RosParameters, RosActions):
    """`simROS2`: the names of the ROS 2 tutorials; times in messages are {sec, nanosec}."""

    _module = "simROS2"
    _time_form = _core.messages.TimeForm.SEC_NANOSEC

    def createPublisher(
        self, topic: str, message_type: str, qos: int | Mapping[str, Any] = 1, latch: bool = False
    ) -> int:
        """Create a publisher and return its handle.

        ``qos`` is a queue size, or a dict with ``depth``, ``history``, ``reliability``, ``durability``, ``deadline``,
        ``lifespan``. ROS 1 has no equivalent of reliability and of the times.
        """
        return self._advertise(topic, message_type, read_qos(qos, self._is_ros2, keeps_last=latch))

    def createSubscription(
        self, topic: str, message_type: str, callback: CallbackOrName, qos: int | Mapping[str, Any] = 1
    ) -> int:
        """Create a subscriber and return its handle; ``callback`` (a function or its name) gets each message as a dict.

        ``qos`` is as in createPublisher. In ROS 1, whether the last message is sent on connection depends on the
        publisher alone.
        """
        guarded = self._caller.callback(callback)
        return self._subscribe(topic, message_type, guarded, read_qos(qos, self._is_ros2), for_script=True)

    def shutdownSubscription(self, subscriber: RosHandle) -> None:
        """Shut down a subscriber; its handle becomes invalid."""
        self._shutdown_subscriber(subscriber)

    def createClient(self, name: str, service_type: str) -> int:
        """Create a service client and return its handle."""
        return self._client(name, service_type)

    def createService(self, name: str, service_type: str, callback: CallbackOrName) -> int:
        """Advertise a service and return its handle; ``callback`` gets a request as a dict and returns the response."""
        return self._server(name, service_type, callback)

    def shutdownClient(self, client: RosHandle) -> None:
        """Shut down a service client; its handle becomes invalid."""
        self._shutdown_client(client)

    def shutdownService(self, server: RosHandle) -> None:
        """Shut down a service server; its handle becomes invalid."""
        self._shutdown_server(server)

    def subscriptionTreatUInt8ArrayAsString(self, subscriber: RosHandle) -> None:
        """Let uint8[] of received messages be strings in Lua, not tables; in Python they are always bytes."""
        self._byte_arrays.deliver_strings(subscriber)

    def clientTreatUInt8ArrayAsString(self, client: RosHandle) -> None:
        """Let uint8[] of responses be strings in Lua, not tables; in Python they are always bytes."""
        self._byte_arrays.deliver_strings(client)

    def serviceTreatUInt8ArrayAsString(self, server: RosHandle) -> None:
        """Let uint8[] of requests be strings in Lua, not tables; in Python they are always bytes."""
        self._byte_arrays.deliver_strings(server)

    def imageTransportCreatePublisher(self, topic: str, queue_size: QueueSize = 1) -> int:
        """Create a publisher of images on ``topic``, and compressed on ``topic``/compressed; return its handle."""
        return self._advertise_images(topic, queue_size)

    def imageTransportCreateSubscription(
        self, topic: str, callback: CallbackOrName, queue_size: QueueSize = 1, transport: str = "raw"
    ) -> int:
        """Create a subscriber of images and return its handle; ``callback`` gets (data, width, height).

        ``transport`` is 'raw', or 'compressed' for ``topic``/compressed. An invalid image is ignored with a warning.
        """
        return self._subscribe_images(topic, callback, queue_size, transport)

    def imageTransportShutdownSubscription(self, subscriber: RosHandle) -> None:
        """Shut down a subscriber of images; its handle becomes invalid."""
        self._shutdown_subscriber(subscriber)

    def createInterface(self, message_type: str) -> dict[str, Any]:
        """Return a message with all fields at their defaults; `package/srv/NameRequest` and `NameResponse` are those of
        a service, `package/action/NameGoal`, `NameResult` and `NameFeedback` those of an action."""
        name = self._part_of_action(message_type) or self._half_of_service(message_type) or message_type
        message: dict[str, Any] = _core.messages.default(name, self._time_form, self._bridge.version)
        return message

    def _part_of_action(self, name: str) -> str | None:
        part = _PART_OF_ACTION.fullmatch(name)
        if part is None:
            return None
        if not self._is_ros2:
            return f"{part['package']}/{part['action']}{part['part']}"
        from bubblesim.messages.runtime import add_action

        return f"{add_action(part['package'] + '/' + part['action'])}_{part['part']}"

    def _half_of_service(self, name: str) -> str | None:
        half = _HALF_OF_SERVICE.fullmatch(name)
        if half is None:
            return None
        halves: tuple[str, str] = _core.messages.service_halves(half["service"], self._bridge.version)
        return halves[0] if half["half"] == "Request" else halves[1]

    def getInterfaceConstants(self, message_type: str) -> dict[str, Any]:
        """Return the constants of a type, by name."""
        constants: dict[str, Any] = _core.messages.constants(message_type, self._bridge.version)
        return constants

    def supportedInterfaces(self) -> list[str]:
        """Return the names of all message and service types of this build."""
        version = self._bridge.version
        return [*_core.messages.message_names(version), *_core.messages.service_names(version)]

    def timeFromFloat(self, seconds: Seconds) -> dict[str, int]:
        """Convert seconds to {sec, nanosec}."""
        return _sec_nanosec(round(seconds * 1e9))

    def timeToFloat(self, time: Stamp) -> float:
        """Convert {sec, nanosec} to seconds."""
        return time["sec"] + time["nanosec"] * 1e-9

    def spinSome(self) -> None:
        """Return at once; for older scripts: messages are delivered at the start of each step."""

    def getTime(self) -> dict[str, int]:
        """Return ROS time as {sec, nanosec}, for stamps: with /use_sim_time the time of the state, else wall time.

        The time of the state is the simulated time, and in sysCall_sensing the end of the step.
        """
        return now(self._bridge)

    def getSystemTime(self) -> dict[str, int]:
        """Return ROS time as {sec, nanosec}."""
        return self.getTime()

    def getSimulationTime(self) -> dict[str, int]:
        """Return the time of the state as {sec, nanosec}, for stamps: that of getTime, also without /use_sim_time."""
        return _sec_nanosec(round(self._simulation.state_time * 1e9))


def _sec_nanosec(nanoseconds: int) -> dict[str, int]:
    return {"sec": nanoseconds // 1_000_000_000, "nanosec": nanoseconds % 1_000_000_000}
