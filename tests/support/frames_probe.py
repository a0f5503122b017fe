# SPDX-License-Identifier: BSD-3-Clause
"""Prints the x, y, z of each named frame in the first one, from tf; ends when it has all of them."""

import sys

import rospy
import tf2_ros

rospy.init_node("frames_probe", anonymous=True)
buffer = tf2_ros.Buffer()
listener = tf2_ros.TransformListener(buffer)
root, *frames = sys.argv[1:]
for frame in frames:
    while not buffer.can_transform(root, frame, rospy.Time(0)):
        rospy.rostime.wallsleep(0.05)
    place = buffer.lookup_transform(root, frame, rospy.Time(0)).transform.translation
    print(frame, place.x, place.y, place.z, flush=True)
