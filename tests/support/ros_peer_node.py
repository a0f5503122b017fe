# SPDX-License-Identifier: BSD-3-Clause
"""The process of ros_peer.Peer: reads commands as JSON lines, writes messages as JSON lines."""

import base64
import contextlib
import json
import sys
import threading
from typing import Any

import genpy
import roslib.message
import rospy
import rosservice
from genpy.message import fill_message_args

LOCK = threading.Lock()
PUBLISHERS: dict[str, rospy.Publisher] = {}


def plain(value: Any) -> Any:
    if isinstance(value, genpy.Message):
        return {name: plain(getattr(value, name)) for name in value.__slots__}
    if isinstance(value, genpy.TVal):
        return value.to_sec()
    if isinstance(value, bytes):
        return {"base64": base64.b64encode(value).decode()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    return value


def report(topic: str, message: genpy.Message) -> None:
    line = json.dumps([topic, plain(message)])
    with LOCK:
        sys.stdout.write(line + "\n")
        sys.stdout.flush()


def subscribe(topic: str, kind: type) -> None:
    rospy.Subscriber(topic, kind, lambda message: report(topic, message))


def publish(topic: str, kind: type, values: dict[str, Any]) -> None:
    if topic not in PUBLISHERS:
        PUBLISHERS[topic] = rospy.Publisher(topic, kind, queue_size=1000)
    while PUBLISHERS[topic].get_num_connections() == 0 and not rospy.is_shutdown():
        rospy.rostime.wallsleep(0.02)
    message = kind()
    fill_message_args(message, [values])
    PUBLISHERS[topic].publish(message)


def call(service: str, values: dict[str, Any]) -> None:
    rospy.wait_for_service(service)
    kind = rosservice.get_service_class_by_name(service)
    request = kind._request_class()
    fill_message_args(request, [values] if values else [])
    report("response", rospy.ServiceProxy(service, kind)(request))


def main() -> None:
    rospy.init_node("peer", anonymous=True, disable_signals=True)
    for line in sys.stdin:
        command = json.loads(line)
        if command["do"] == "call":
            call(command["topic"], command["request"])
            continue
        kind = roslib.message.get_message_class(command["type"])
        if command["do"] == "subscribe":
            subscribe(command["topic"], kind)
        else:
            publish(command["topic"], kind, command["message"])


if __name__ == "__main__":
    with contextlib.suppress(KeyboardInterrupt):
        main()
