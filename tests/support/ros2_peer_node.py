# SPDX-License-Identifier: BSD-3-Clause
"""The process of ros2_peer.Ros2Peer: a node of rclpy, which reads commands as JSON lines and writes JSON lines.

It runs in the environment of rclpy, which knows nothing of bubblesim and of ROS 1.
"""

import base64
import contextlib
import importlib
import json
import os
import re
import sys
import threading
import time
from typing import Any

import numpy as np
import rclpy
from rclpy.action import ActionClient, ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message, serialize_message

LOCK = threading.Lock()
SEQUENCE = re.compile(r"(?:sequence<)?([\w/]+)(?:, \d+>|>|\[\d+\])?")


def type_of(name: str) -> Any:
    """`std_msgs/msg/Float32` -> the class."""
    package, folder, short = name.split("/")
    return getattr(importlib.import_module(f"{package}.{folder}"), short)


def plain(value: Any) -> Any:
    """Return a message as JSON can hold it."""
    if hasattr(value, "get_fields_and_field_types"):
        types = value.get_fields_and_field_types()
        return {name: numbers(types[name], getattr(value, name)) for name in types}
    if isinstance(value, bytes) or getattr(value, "typecode", "") == "B":
        return {"base64": base64.b64encode(bytes(value)).decode()}
    if isinstance(value, np.ndarray) or hasattr(value, "tolist"):
        return [plain(item) for item in value.tolist()]
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    return value


def numbers(spelling: str, value: Any) -> Any:
    """Return a field as JSON can hold it; rclpy has bytes of length 1 for an octet."""
    if spelling == "octet":
        return value[0]
    return [octet[0] for octet in value] if "octet" in spelling else plain(value)


def fill(message: Any, values: dict[str, Any]) -> Any:
    """Set the fields of a message."""
    types = message.get_fields_and_field_types()
    for name, value in values.items():
        if isinstance(value, dict) and value.keys() == {"base64"}:
            setattr(message, name, base64.b64decode(value["base64"]))
        elif isinstance(value, dict):
            fill(getattr(message, name), value)
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            package, short = SEQUENCE.fullmatch(types[name])[1].split("/")
            setattr(message, name, [fill(type_of(f"{package}/msg/{short}")(), item) for item in value])
        elif types[name] == "octet":
            setattr(message, name, bytes([value]))
        else:
            setattr(message, name, value)
    return message


def profile(qos: dict[str, Any]) -> QoSProfile:
    return QoSProfile(
        depth=qos.get("depth", 10),
        history=HistoryPolicy.KEEP_LAST,
        reliability=ReliabilityPolicy.BEST_EFFORT if qos.get("best_effort") else ReliabilityPolicy.RELIABLE,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if qos.get("transient_local") else DurabilityPolicy.VOLATILE,
    )


def report(topic: str, value: Any) -> None:
    with LOCK:
        sys.stdout.write(json.dumps([topic, value]) + "\n")
        sys.stdout.flush()


class Peer:
    """Carries out the commands."""

    def __init__(self, node: Node) -> None:
        self.node = node
        self.publishers: dict[str, Any] = {}
        self.kept: list[Any] = []
        self.goal: Any = None

    def subscribe(self, topic: str, type: str, qos: dict[str, Any]) -> None:  # noqa: A002
        def received(message: Any) -> None:
            report(topic, plain(message))

        self.kept.append(self.node.create_subscription(type_of(type), topic, received, profile(qos)))

    def publish(self, topic: str, type: str, message: dict[str, Any], qos: dict[str, Any]) -> None:  # noqa: A002
        if topic not in self.publishers:
            self.publishers[topic] = self.node.create_publisher(type_of(type), topic, profile(qos))
        while self.publishers[topic].get_subscription_count() == 0 and not qos.get("transient_local"):
            time.sleep(0.01)
        self.publishers[topic].publish(fill(type_of(type)(), message))

    def send_bytes(self, topic: str, type: str, data: list[str]) -> None:  # noqa: A002
        publisher = self.node.create_publisher(type_of(type), topic, 100)
        while publisher.get_subscription_count() == 0:
            time.sleep(0.01)
        for each in data:
            publisher.publish(base64.b64decode(each))
            time.sleep(0.002)  # the subscriber keeps a few only
        self.kept.append(publisher)

    def call(self, service: str, type: str, request: dict[str, Any]) -> None:  # noqa: A002
        kind = type_of(type)
        client = self.node.create_client(kind, service)
        self.kept.append(client)
        client.wait_for_service()
        client.call_async(fill(kind.Request(), request)).add_done_callback(
            lambda future: report("response", plain(future.result()))
        )

    def serve(self, service: str, type: str, response: dict[str, Any]) -> None:  # noqa: A002
        def answer(request: Any, answered: Any) -> Any:
            report(service, plain(request))
            return fill(answered, response)

        self.kept.append(self.node.create_service(type_of(type), service, answer))

    def send_goal(self, action: str, type: str, goal: dict[str, Any]) -> None:  # noqa: A002
        kind = type_of(type)
        client = ActionClient(self.node, kind, action)
        client.wait_for_server()

        def ended(future: Any) -> None:
            report("result", {"status": future.result().status, "result": plain(future.result().result)})

        def answered(future: Any) -> None:
            self.goal = future.result()
            report("goal", {"accepted": self.goal.accepted})
            if self.goal.accepted:
                self.goal.get_result_async().add_done_callback(ended)

        def received(message: Any) -> None:
            report("feedback", plain(message.feedback))

        self.kept.append(client)
        client.send_goal_async(fill(kind.Goal(), goal), feedback_callback=received).add_done_callback(answered)

    def cancel(self) -> None:
        def answered(future: Any) -> None:
            report("cancel", {"code": future.result().return_code, "goals": len(future.result().goals_canceling)})

        self.goal.cancel_goal_async().add_done_callback(answered)

    def act(self, action: str) -> None:
        """Serve test_msgs/action/Fibonacci: a negative order is rejected, one above 100 runs until it is cancelled."""
        kind = type_of("test_msgs/action/Fibonacci")

        def execute(handle: Any) -> Any:
            sequence = [0, 1]
            while len(sequence) < handle.request.order:
                if handle.is_cancel_requested:
                    handle.canceled()
                    return kind.Result(sequence=sequence)
                if len(sequence) < 40:
                    sequence.append(sequence[-1] + sequence[-2])
                handle.publish_feedback(kind.Feedback(sequence=sequence))
                time.sleep(0.05)
            handle.succeed()
            return kind.Result(sequence=sequence)

        self.kept.append(
            ActionServer(
                self.node,
                kind,
                action,
                execute,
                goal_callback=lambda goal: GoalResponse.ACCEPT if goal.order >= 0 else GoalResponse.REJECT,
                cancel_callback=lambda _goal: CancelResponse.ACCEPT,
                callback_group=ReentrantCallbackGroup(),
            )
        )

    def graph(self) -> None:
        topics = {
            name: {
                "types": types,
                "publishers": [self.described(each) for each in self.node.get_publishers_info_by_topic(name)],
                "subscribers": [self.described(each) for each in self.node.get_subscriptions_info_by_topic(name)],
            }
            for name, types in self.node.get_topic_names_and_types()
        }
        nodes = [f"{space.rstrip('/')}/{name}" for name, space in self.node.get_node_names_and_namespaces()]
        report("graph", {"topics": topics, "nodes": nodes, "services": dict(self.node.get_service_names_and_types())})

    @staticmethod
    def described(info: Any) -> dict[str, Any]:
        return {
            "node": f"{info.node_namespace.rstrip('/')}/{info.node_name}",
            "type_hash": str(info.topic_type_hash),
            "reliability": info.qos_profile.reliability.name,
            "durability": info.qos_profile.durability.name,
        }

    def encode(self, type: str, message: dict[str, Any]) -> None:  # noqa: A002
        report("bytes", base64.b64encode(serialize_message(fill(type_of(type)(), message))).decode())

    def decode(self, type: str, data: str) -> None:  # noqa: A002
        report("message", plain(deserialize_message(base64.b64decode(data), type_of(type))))

    def recode(self, type: str, data: str) -> None:  # noqa: A002
        message = deserialize_message(base64.b64decode(data), type_of(type))
        report("recoded", {"message": plain(message), "bytes": base64.b64encode(serialize_message(message)).decode()})


def main() -> None:
    rclpy.init()
    node = Node("peer")
    peer = Peer(node)
    executor = MultiThreadedExecutor(4)
    executor.add_node(node)

    def spin() -> None:
        with contextlib.suppress(ExternalShutdownException):
            executor.spin()

    threading.Thread(target=spin, daemon=True).start()
    report("ready", True)
    with contextlib.suppress(KeyboardInterrupt):
        for line in sys.stdin:
            command = json.loads(line)
            getattr(peer, command.pop("do"))(**command)
    sys.stdout.flush()
    os._exit(0)  # rclpy's threads do not end before the interpreter, which aborts then


if __name__ == "__main__":
    main()
