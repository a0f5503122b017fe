# SPDX-License-Identifier: BSD-3-Clause
"""Monitors the Pioneer's mapping of its room; run by test_pioneer_slam.py. Arguments: simulated seconds from when the
robot explores and all topics arrive, map file.

Prints as JSON: when the explorer finished (None if it did not), the errors of the estimated poses, the gaps between
scans, the number of scans, and the number that the mapper lost. If exploration ends before the time is up, the robot
drives to goals in the room.
"""

import json
import math
import sys
import time

import numpy as np
import rospy
import tf2_ros
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import OccupancyGrid, Odometry, Path
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Bool
from tf2_msgs.msg import TFMessage

PLACES = [(-2.5, 2.2), (2.7, 2.2), (0.5, -2.4), (-2.4, -2.3), (3.3, 0.3), (0.0, 1.0)]

rospy.init_node("watch_mapping")
truth, maps, stamps, corrections, arrivals, paths = [], [], [], [], [], []
done_at = None
transforms = tf2_ros.Buffer(rospy.Duration(1000))
tf2_ros.TransformListener(transforms)
rospy.Subscriber("/tf", TFMessage, lambda m: corrections.extend(t for t in m.transforms if t.child_frame_id == "odom"))
rospy.Subscriber("/ground_truth", Odometry, truth.append)
rospy.Subscriber("/map", OccupancyGrid, maps.append)
rospy.Subscriber("/scan", LaserScan, lambda scan: stamps.append(scan.header.stamp.to_sec()))
rospy.Subscriber("/go_to/path", Path, paths.append)
rospy.Subscriber("/go_to/arrived", Bool, arrivals.append)
done = []
rospy.Subscriber("/explore/done", Bool, done.append)
goals = rospy.Publisher("/move_base_simple/goal", PoseStamped, queue_size=1)

end = time.monotonic() + 900
sent = 0
# Nodes start slowly on a busy machine: the time counts from here.
while not (truth and maps and stamps and corrections and paths) and time.monotonic() < end:
    time.sleep(0.1)
begin = rospy.get_time()
while rospy.get_time() < begin + float(sys.argv[1]) and time.monotonic() < end:
    if done and done_at is None:
        done_at = rospy.get_time()
        arrivals.clear()
    if done_at is not None and len(arrivals) >= sent:
        goal = PoseStamped()
        goal.header.frame_id = "map"
        goal.pose.position.x, goal.pose.position.y = PLACES[sent % len(PLACES)]
        goal.pose.orientation.w = 1.0
        goals.publish(goal)
        sent += 1
    time.sleep(0.1)

errors = []
for message in truth:
    try:
        place = transforms.lookup_transform("map", "base_link", message.header.stamp).transform.translation
    except tf2_ros.TransformException:
        continue  # before the first scan
    position = message.pose.pose.position
    errors.append(math.hypot(place.x - position.x, place.y - position.y))

# The mapper answers each scan with a correction stamped a tenth of a second later.
answered = {round(correction.header.stamp.to_sec() - 0.1, 3) for correction in corrections}
first, last = min(answered), max(answered)
stamps = [round(stamp, 3) for stamp in stamps]

info = maps[-1].info
origin = [info.origin.position.x, info.origin.position.y]
cells = np.array(maps[-1].data, np.int8).reshape(info.height, info.width)
np.savez(sys.argv[2], cells=cells, origin=origin, resolution=info.resolution)
print(
    json.dumps(
        {
            "time": rospy.get_time(),
            "done_at": done_at,
            "errors": errors,
            "longest_gap": float(np.max(np.diff(stamps))),
            "scans": len(stamps),
            "lost": len([stamp for stamp in stamps if first < stamp < last and stamp not in answered]),
            "arrived": [arrival.data for arrival in arrivals],
        }
    )
)
