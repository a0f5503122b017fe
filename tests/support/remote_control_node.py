# SPDX-License-Identifier: BSD-3-Clause
"""The node of remote_control.py: publishes Bools as read from stdin, a topic, a value and a number of messages per
line, and prints the messages on its arguments, topic=Type of std_msgs."""

import sys
import time

import rospy
import std_msgs.msg

COMMANDS = ("/startSimulation", "/pauseSimulation", "/stopSimulation", "/enableSyncMode", "/triggerNextStep")

rospy.init_node("remote_control")
publishers = {topic: rospy.Publisher(topic, std_msgs.msg.Bool, queue_size=1000) for topic in COMMANDS}
for argument in sys.argv[1:]:
    received, _, type_name = argument.partition("=")
    rospy.Subscriber(
        received,
        getattr(std_msgs.msg, type_name),
        lambda message, topic=received: sys.stdout.write(f"{topic} {message.data}\n"),
    )
while not all(publisher.get_num_connections() for publisher in publishers.values()):
    time.sleep(0.01)
sys.stdout.write("connected\n")  # at once: print() writes the end of the line on its own
for line in sys.stdin:
    pressed, value, count = line.split()
    for _ in range(int(count)):
        publishers[pressed].publish(value == "True")
