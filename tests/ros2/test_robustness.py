# SPDX-License-Identifier: BSD-3-Clause
"""What peers of ROS 2 do neither ends nor holds up the simulation."""

import random
import re
import socket
import struct
import time
from pathlib import Path

from node_support import Node, write
from ros2_peer import Domain, Ros2Peer
from ros_support import DEADLINE, wait_until

SCRIPT = """
    import numpy as np

    def sysCall_init():
        self.image = simROS2.createPublisher('/image', 'sensor_msgs/Image')
        self.out = simROS2.createPublisher('/out', 'std_msgs/Float32')
        simROS2.createSubscription('/joints', 'sensor_msgs/JointState', 'on_joints', 100)
        self.pixels = np.zeros(640 * 480 * 3, np.uint8)

    def on_joints(message):
        print('joints', message['name'], flush=True)

    def sysCall_sensing():
        simROS2.publish(self.image, {'width': 640, 'height': 480, 'step': 1920, 'data': self.pixels})
        simROS2.publish(self.out, {'data': sim.getSimulationTime()})
        print('at', f'{sim.getSimulationTime():.2f}', flush=True)
"""


def node_with(domain: Domain, folder: Path) -> Node:
    file = write(folder / "script.py", SCRIPT)
    return Node(domain.env(), folder / "log", "ball", "--ros=2", "--child-script", f"/Ball={file}")


def seconds(node: Node) -> float:
    """Return the simulation time that the script has printed last."""
    return float([0.0, *re.findall(r"^at ([0-9.]+)$", node.output, re.MULTILINE)][-1])


def test_a_stopped_subscriber_does_not_stop_the_simulation(
    ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path
) -> None:
    with node_with(ros2_domain, tmp_path) as node:
        ros2_peer.next("/image", "sensor_msgs/msg/Image", count=3)
        ros2_peer.stop()
        try:
            node.wait_for_output("at ")
            then = seconds(node)
            wait_until(lambda: seconds(node) > then + 3.0, "three more seconds")
        finally:
            ros2_peer.go_on()
        ros2_peer.next("/image", count=3)


IMAGES = """
    import numpy as np

    def sysCall_init():
        self.image = simROS2.createPublisher('/image', 'sensor_msgs/Image', {'depth': 100})
        self.pixels = np.zeros(640 * 480 * 3, np.uint8)
        self.count = 0

    def sysCall_sensing():
        self.count += 1
        message = {'header': {'frame_id': str(self.count)}, 'width': 640, 'height': 480, 'step': 1920}
        simROS2.publish(self.image, {**message, 'data': self.pixels})
"""


def test_large_images_reach_a_reliable_subscriber_one_and_all_beside_a_best_effort_one(
    ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path
) -> None:
    """Of a best-effort subscriber's, some fit into its socket's buffer of 212 kB."""
    file = write(tmp_path / "script.py", IMAGES)
    kind = "sensor_msgs/msg/Image"
    with (
        Ros2Peer(ros2_domain, tmp_path / "other.log") as other,
        Node(ros2_domain.env(), tmp_path / "log", "ball", "--ros=2", "--child-script", f"/Ball={file}"),
    ):
        other.received("/image", kind, best_effort=True)
        ros2_peer.next("/image", kind, count=30, depth=100)
        other.next("/image")
    numbers = [int(message["header"]["frame_id"]) for message in ros2_peer.received("/image")]
    assert numbers == list(range(numbers[0], numbers[0] + len(numbers)))
    assert {len(message["data"]) for message in other.received("/image")} == {640 * 480 * 3}  # whole ones


def test_messages_that_are_broken_are_dropped(ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path) -> None:
    whole = ros2_peer.encode("sensor_msgs/msg/JointState", {"name": ["a", "b"], "position": [1.0, 2.0]})
    chance = random.Random(1)
    broken = [whole[: chance.randrange(4, len(whole))] for _ in range(100)]
    for _ in range(300):
        changed = bytearray(whole)
        for _ in range(chance.randrange(1, 8)):
            changed[chance.randrange(4, len(changed))] = chance.randrange(256)
        broken.append(bytes(changed))
    broken += [b"\0\1\0\0" + chance.randbytes(chance.randrange(200)) for _ in range(200)]
    with node_with(ros2_domain, tmp_path) as node:
        ros2_peer.send_bytes("/joints", "sensor_msgs/msg/JointState", [*broken, whole])
        node.wait_for_output("warning: dropped a message on '/joints': MessageError: sensor_msgs/JointState: ")
        ros2_peer.publish("/joints", "sensor_msgs/msg/JointState", {"name": ["the", "end"]})
        node.wait_for_output("joints ['the', 'end']")
        assert ros2_peer.next("/out", "std_msgs/msg/Float32").keys() == {"data"}


def test_junk_on_the_ports_of_discovery_is_ignored(ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path) -> None:
    chance = random.Random(2)
    header = b"RTPS\2\3\1\x0f" + bytes(12)
    first = 7400 + 250 * ros2_domain.number
    with node_with(ros2_domain, tmp_path) as node, socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        ros2_peer.next("/out", "std_msgs/msg/Float32")
        for _ in range(3000):
            body = b"".join(
                struct.pack(
                    "<BBH", chance.choice([1, 6, 7, 8, 9, 0x0C, 0x0D, 0x0E, 0x0F, 0x15, 0x16, 0x17, 255]), 1, size
                )
                + chance.randbytes(chance.choice([size, size // 2]))
                for size in [chance.randrange(120) for _ in range(chance.randrange(1, 4))]
            )
            packet = chance.choice([header + body, chance.randbytes(chance.randrange(1, 300)), header])
            for offset in (10, 11, 12, 13):  # of the first two participants of a machine
                sender.sendto(packet, ("127.0.0.1", first + offset))
        then = seconds(node)
        wait_until(lambda: seconds(node) > then + 1.0, "another second")
        with Ros2Peer(ros2_domain, tmp_path / "late.log") as late:
            assert late.next("/out", "std_msgs/msg/Float32").keys() == {"data"}


def announcement(number: int, port: int) -> bytes:
    """Return an announcement of a participant that is found at a port (OMG DDSI-RTPS 2.3, 8.5.3, 9.6.2.2)."""
    prefix = struct.pack("<4sII", b"\1\x0fab", number, 1)
    place = struct.pack("<iI12s4s", 1, port, b"", bytes([127, 0, 0, 1]))
    parameters = {
        0x0015: b"\2\3\0\0",  # version of the protocol
        0x0016: b"\1\x0f\0\0",  # vendor
        0x0050: prefix + b"\0\0\1\xc1",  # GUID
        0x0032: place,  # of discovery
        0x0031: place,  # of messages
        0x0002: struct.pack("<iI", 20, 0),  # lease, s
        0x0058: struct.pack("<I", 0x3F),  # it has the endpoints of discovery
        0x0001: b"",  # end
    }
    body = b"\0\3\0\0" + b"".join(struct.pack("<HH", key, len(value)) + value for key, value in parameters.items())
    data = struct.pack("<HH4s4siI", 0, 16, b"\0\1\0\xc7", b"\0\1\0\xc2", 0, 1) + body
    return b"RTPS\2\3\1\x0f" + prefix + struct.pack("<BBH", 0x15, 5, len(data)) + data


def test_a_thousand_participants_do_not_hold_up_the_simulation(
    ros2_domain: Domain, ros2_peer: Ros2Peer, tmp_path: Path
) -> None:
    first = 7400 + 250 * ros2_domain.number
    with node_with(ros2_domain, tmp_path) as node, socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        sender.bind(("127.0.0.1", 0))
        sender.settimeout(DEADLINE)
        port = sender.getsockname()[1]
        ros2_peer.next("/out", "std_msgs/msg/Float32")
        for number in range(1000):
            for offset in (10, 12):  # the ports of discovery of the first two participants of a machine
                sender.sendto(announcement(number, port), ("127.0.0.1", first + offset))
            time.sleep(0.001)  # what waits in a socket is limited
        assert sender.recv(65536).startswith(b"RTPS")  # they were taken seriously: an answer has come
        then = seconds(node)
        wait_until(lambda: seconds(node) > then + 1.0, "another second")
        before = len(ros2_peer.received("/out"))
        wait_until(lambda: len(ros2_peer.received("/out")) > before + 10, "more messages")
