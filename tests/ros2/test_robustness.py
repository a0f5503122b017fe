# SPDX-License-Identifier: BSD-3-Clause
"""What peers of ROS 2 do neither ends nor holds up the simulation."""

import random
import socket
import struct
from pathlib import Path

from node_support import Node, write
from ros2_peer import Domain, Ros2Peer
from ros_support import wait_until

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
    return float(node.output.rpartition("at ")[2].split("\n", 1)[0] or 0.0)


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
