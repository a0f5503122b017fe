# SPDX-License-Identifier: BSD-3-Clause
"""A typical subscriber and echo in rospy, for traffic.py."""

from collections import Counter

import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Image, LaserScan, PointCloud2

QUEUE = 1000
LARGEST = 1 << 22  # bytes read at once

counts: Counter[str] = Counter()


def count(_: object, name: str) -> None:
    """Count a message."""
    counts[name] += 1


rospy.init_node("rospy")
for name, kind in {"twist": Twist, "scan": LaserScan, "image": Image, "cloud": PointCloud2}.items():
    rospy.Subscriber(f"~{name}", kind, count, name, queue_size=QUEUE, buff_size=LARGEST, tcp_nodelay=True)
pong = rospy.Publisher("~pong", Twist, queue_size=QUEUE, tcp_nodelay=True)
rospy.Subscriber("~ping", Twist, pong.publish, queue_size=QUEUE, tcp_nodelay=True)
rospy.spin()
for name, seen in counts.items():
    print(name, seen)
