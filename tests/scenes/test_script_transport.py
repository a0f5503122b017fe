# SPDX-License-Identifier: BSD-3-Clause
"""Transport hints of simROS.subscribe, as received by the publishers."""

import subprocess
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from node_support import Node
from ros_support import RosCore, start, stop, wait_until

Script = Callable[[str], Node]

# Prints the TCP_NODELAY field of each subscriber's connection header.
TALKER = """
import rospy, std_msgs.msg
from rospy.impl.tcpros_pubsub import TCPROSHandler
as_before = TCPROSHandler.topic_connection_handler
def report(self, sock, address, header):
    print(header['topic'], header.get('tcp_nodelay'))
    return as_before(self, sock, address, header)
TCPROSHandler.topic_connection_handler = report
rospy.init_node('talker')
publishers = [rospy.Publisher(t, std_msgs.msg.String, queue_size=1, latch=True) for t in ('/fast', '/slow', '/either')]
for publisher in publishers:
    publisher.publish('hello')
rospy.spin()
"""


@contextmanager
def talker(core: RosCore, log: Path) -> Iterator[None]:
    with log.open("w") as file:
        process = start(["/usr/bin/python3", "-c", TALKER], core.env, stdout=file, stderr=subprocess.STDOUT)
        try:
            yield
        finally:
            stop(process)


def test_publishers_are_asked_for_what_the_script_wants(script: Script, roscore: RosCore, tmp_path: Path) -> None:
    log = tmp_path / "talker"
    node = script("""\
        def receive(topic):
            return lambda message: print('received', topic, message['data'])
        def sysCall_init():
            wanted = {'/fast': {'tcpNoDelay': True}, '/slow': {'tcpNoDelay': False},
                      '/either': {'transports': ['unreliable', 'reliable'], 'maxDatagramSize': 1000}}
            for topic, hints in wanted.items():
                simROS.subscribe(topic, 'std_msgs/String', receive(topic), 1, hints)
            try:
                simROS.subscribe('/fast', 'std_msgs/String', print, 1, {'transports': ['smoke']})
            except ValueError as error:
                print('reported:', error)
            print('done')
        """)
    with talker(roscore, log):
        for topic in ("/fast", "/slow", "/either"):
            node.wait_for_output(f"received {topic} hello")
        wanted = {"/either 1", "/fast 1", "/slow 0"}
        wait_until(lambda: set(log.read_text().splitlines()) - {"/rosout 1", "/rosout 0"} == wanted, "the headers")
    node.wait_for_output("done")
    assert "'/either' is subscribed over TCP: UDP is not supported" in node.output
    assert "reported: transports must hold 'reliable', 'tcp', 'unreliable', 'udp'; found str 'smoke'" in node.output
