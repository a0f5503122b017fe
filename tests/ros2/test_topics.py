# SPDX-License-Identifier: BSD-3-Clause
"""Topics of the node with nodes of ROS 2."""

import threading
import time
from pathlib import Path

import pytest

from node_support import Node, write
from ros2_peer import Domain, Ros2Peer
from ros_support import wait_until

FLOAT = "std_msgs/msg/Float32"


def node_with(domain: Domain, folder: Path, script: str, *options: object) -> Node:
    file = write(folder / "script.py", script)
    return Node(domain.env(), folder / "log", "ball", "--ros=2", "--child-script", f"/Ball={file}", *options)


@pytest.mark.parametrize("module", ["simROS", "simROS2"])
def test_scripts_publish_and_receive(module: str, ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path) -> None:
    advertise, subscribe = (
        ("advertise", "subscribe") if module == "simROS" else ("createPublisher", "createSubscription")
    )
    script = f"""
        def sysCall_init():
            self.out = {module}.{advertise}('/out', 'std_msgs/Float32')
            {module}.{subscribe}('/in', 'std_msgs/msg/Float32', 'on_in')
            self.value = 0.5

        def on_in(message):
            self.value = message['data']

        def sysCall_sensing():
            {module}.publish(self.out, {{'data': self.value}})
    """
    with node_with(ros2_domain, tmp_path, script):
        assert ros2_peer.next("/out", FLOAT) == {"data": 0.5}
        ros2_peer.publish("/in", FLOAT, {"data": 7.25})
        ros2_peer.wait_for("/out", FLOAT, lambda message: message["data"] == 7.25, "the value that was sent")


def test_relative_names_are_in_the_namespace_and_private_ones_below_the_node(
    ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path
) -> None:
    script = """
        def sysCall_init():
            for name in ('speed', '~/state', '~old', '/given'):
                simROS2.createPublisher(name, 'std_msgs/Float32')
    """
    with node_with(ros2_domain, tmp_path, script, "__ns:=/robots", "__name:=sim", "/given:=/taken"):
        wait_until(lambda: "/taken" in ros2_peer.graph()["topics"], "the topics")
        topics = ros2_peer.graph()["topics"]
    assert {"/robots/speed", "/robots/sim/state", "/robots/sim/old", "/taken"} <= topics.keys()
    assert "/given" not in topics


QOS = """
    def sysCall_init():
        simROS2.createPublisher('/kept', 'std_msgs/String', {'depth': 3, 'durability': 'transient_local'})
        simROS2.createPublisher('/fast', 'std_msgs/String', {'reliability': 'best_effort'})
        simROS2.createSubscription('/read', 'std_msgs/String', print, {'reliability': 'best_effort'})
        simROS2.sendStaticTransform({'child_frame_id': 'b', 'transform': {'rotation': {'w': 1.0}}})
        kept = simROS2.createPublisher('/last', 'std_msgs/String', {'depth': 2, 'durability': 'transient_local'})
        for text in 'abc':
            simROS2.publish(kept, {'data': text})
"""


def test_qos_is_that_of_the_script(ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path) -> None:
    with node_with(ros2_domain, tmp_path, QOS):
        wait_until(lambda: "/tf_static" in ros2_peer.graph()["topics"], "the topics")
        wait_until(lambda: ros2_peer.graph()["topics"]["/read"]["subscribers"] != [], "the subscriber")
        topics = ros2_peer.graph()["topics"]

        def policies(topic: str, kind: str = "publishers") -> tuple[str, str]:
            (endpoint,) = topics[topic][kind]
            return endpoint["reliability"], endpoint["durability"]

        assert policies("/kept") == ("RELIABLE", "TRANSIENT_LOCAL")
        assert policies("/fast") == ("BEST_EFFORT", "VOLATILE")
        assert policies("/read", "subscribers") == ("BEST_EFFORT", "VOLATILE")
        assert policies("/tf_static") == ("RELIABLE", "TRANSIENT_LOCAL")
        assert topics["/tf_static"]["types"] == ["tf2_msgs/msg/TFMessage"]
        # A late subscriber gets what the depth keeps.
        ros2_peer.received("/last", "std_msgs/msg/String", transient_local=True, depth=10)
        wait_until(lambda: len(ros2_peer.received("/last")) >= 2, "the messages that were kept")
        time.sleep(0.3)
        assert [message["data"] for message in ros2_peer.received("/last")] == ["b", "c"]


def test_best_effort_subscriber_receives_from_a_best_effort_publisher(
    ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path
) -> None:
    script = """
        def sysCall_init():
            simROS2.createSubscription('/in', 'std_msgs/Float32', 'on_in', {'reliability': 'best_effort'})

        def on_in(message):
            print('received', message['data'], flush=True)
    """
    with node_with(ros2_domain, tmp_path, script) as node:

        def arrives() -> bool:
            """What is published before the subscriber knows the publisher is lost: it is not sent again."""
            ros2_peer.publish("/in", FLOAT, {"data": 2.5}, best_effort=True)
            return "received 2.5" in node.output

        wait_until(arrives, "'received 2.5' in the output")


def test_large_images_arrive_whole_at_thirty_a_second(ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path) -> None:
    script = """
        import numpy as np

        def sysCall_init():
            self.image = simROS.imageTransportAdvertise('/image', 60)
            self.number = 0
            self.pixels = np.random.default_rng(1).integers(0, 255, 640 * 480 * 3, np.uint8)

        def sysCall_sensing():
            if simROS.wantsMessages(self.image) and self.number < 60:
                self.number += 1
                self.pixels[:3] = self.number
                simROS.imageTransportPublish(self.image, self.pixels, 640, 480, 'camera')
    """
    with node_with(ros2_domain, tmp_path, script):
        ros2_peer.received("/image", "sensor_msgs/msg/Image", depth=60)
        wait_until(lambda: len(ros2_peer.received("/image")) >= 60, "60 images", 60.0)
    images = ros2_peer.received("/image")
    assert [image["data"][-640 * 3] for image in images] == list(range(1, 61))
    assert {len(image["data"]) for image in images} == {640 * 480 * 3}


PUBLISHES_AT_ITS_END = """
    def sysCall_init():
        self.topics = [simROS2.createPublisher(f'/topic{n}', 'std_msgs/msg/Float32', 100) for n in range(20)]

    def sysCall_actuation():
        publish(-1.0)

    def sysCall_cleanup():
        for count in range(50):
            publish(count)
        print('published', flush=True)

    def publish(number):
        for topic in self.topics:
            simROS2.publish(topic, {'data': number})
"""
ITS_TOPICS = [f"/topic{n}" for n in range(20)]


def test_what_a_script_publishes_at_its_end_arrives(ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path) -> None:
    with node_with(ros2_domain, tmp_path, PUBLISHES_AT_ITS_END) as node:
        for topic in ITS_TOPICS:
            ros2_peer.next(topic, FLOAT)
        assert node.end() == 0
        for topic in ITS_TOPICS:
            wait_until(lambda topic=topic: ros2_peer.received(topic)[-1] == {"data": 49.0}, f"the last one on {topic}")


def test_the_end_waits_for_a_subscriber_that_is_late(ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path) -> None:
    with node_with(ros2_domain, tmp_path, PUBLISHES_AT_ITS_END) as node:
        for topic in ITS_TOPICS:
            ros2_peer.next(topic, FLOAT)

        def go_on() -> None:
            """The node waits for half a second."""
            node.wait_for_output("published")
            ros2_peer.go_on()

        ros2_peer.stop()
        continued = threading.Thread(target=go_on)
        continued.start()
        assert node.end() == 0
        continued.join()
        for topic in ITS_TOPICS:
            wait_until(lambda topic=topic: ros2_peer.received(topic)[-1] == {"data": 49.0}, f"the last one on {topic}")


def test_the_end_does_not_wait_for_subscribers_that_are_stopped(
    ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path
) -> None:
    with node_with(ros2_domain, tmp_path, PUBLISHES_AT_ITS_END) as node:
        for topic in ITS_TOPICS:
            ros2_peer.next(topic, FLOAT)
        ros2_peer.stop()
        begun = time.monotonic()
        status = node.end()
        took = time.monotonic() - begun
        ros2_peer.go_on()
        assert status == 0
    assert took < 6.0  # half a second for all topics, not for each


def test_a_topic_has_one_type_in_a_node(ros2_domain: Domain, tmp_path: Path) -> None:
    script = """
        def sysCall_init():
            simROS2.createPublisher('/a', 'std_msgs/Float32')
            try:
                simROS2.createPublisher('/a', 'std_msgs/String')
            except ValueError as error:
                print(error, flush=True)
            simROS2.createPublisher('/simulationTime', 'std_msgs/String')
            print('done', flush=True)
    """
    with node_with(ros2_domain, tmp_path, script) as node:
        node.wait_for_output("done")
        assert "topic '/a' is already advertised here as std_msgs/Float32, not std_msgs/String" in node.output


def test_names_that_are_none_are_refused(ros2_domain: Domain, tmp_path: Path) -> None:
    script = """
        def sysCall_init():
            for name in ('', '/', 'a//b', '/1a', 'a b', 'a/'):
                try:
                    simROS2.createPublisher(name, 'std_msgs/Float32')
                except ValueError as error:
                    print(error, flush=True)
            print('done', flush=True)
    """
    with node_with(ros2_domain, tmp_path, script) as node:
        node.wait_for_output("done")
        assert [line for line in node.output.splitlines() if line.startswith("invalid")] == [
            "invalid topic name '': it is empty",
            "invalid topic name '/': it has no name part",
            "invalid topic name 'a//b': it has an empty part",
            "invalid topic name '/1a': a part begins with a digit",
            "invalid topic name 'a b': character ' ' is not allowed",
            "invalid topic name 'a/': it ends with '/'",
        ]
