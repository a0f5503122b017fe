# SPDX-License-Identifier: BSD-3-Clause
"""The mapping node, in simulated time."""

import subprocess
from pathlib import Path

import pytest

from bubblesim.navigation.map_files import read_map
from node_types import Ask, Start
from ros_support import DEADLINE, RosCore, wait_until

# A robot drives 2 m in a room of 8 x 6 m; its odometry reports 10 % more, and it scans a full turn every 0.2 m.
MAPPING = """
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Header
from std_srvs.srv import Empty, Trigger
from nav_msgs.srv import GetMap

maps, metadata = [], []
rospy.Subscriber("map", OccupancyGrid, maps.append)
rospy.Subscriber("map_metadata", MapMetaData, metadata.append)
scans = rospy.Publisher("scan", LaserScan, queue_size=100)
clock = rospy.Publisher("/clock", Clock, queue_size=10)
transforms = tf2_ros.TransformBroadcaster()
buffer = tf2_ros.Buffer()
tf2_ros.TransformListener(buffer)
wait_until(lambda: scans.get_num_connections() > 0, "the mapper")
wait_until(lambda: transforms.pub_tf.get_num_connections() > 1, "the subscribers of transforms")

def range_at(x, angle):  # the room extends from (-2, -3) to (6, 3)
    along, up = math.cos(angle), math.sin(angle)
    to_side = (6 - x if along > 0 else -2 - x) / along
    to_end = math.copysign(3, up) / up
    return min(to_side, to_end)

def look(start):
    for step in range(11):
        stamp = rospy.Time.from_sec(start + 0.5 * step)
        clock.publish(stamp)
        time.sleep(0.05)
        place = TransformStamped(header=Header(stamp=stamp, frame_id="odom"), child_frame_id="base_link")
        place.transform.translation.x = 1.1 * 0.2 * step
        place.transform.rotation.w = 1.0
        transforms.sendTransform(place)
        scan = LaserScan(header=Header(stamp=stamp, frame_id="base_link"), angle_min=-3.0, angle_increment=0.02)
        scan.range_min, scan.range_max = 0.1, 20.0
        scan.angle_max = -3.0 + 299 * 0.02
        scan.ranges = [range_at(0.2 * step, -3.0 + 0.02 * ray + 1e-6) for ray in range(300)]
        scans.publish(scan)
        time.sleep(0.05)

def place_at(seconds):
    try:
        found = buffer.lookup_transform("map", "odom", rospy.Time.from_sec(seconds))
    except tf2_ros.TransformException:
        return None
    return found.transform.translation.x

start = 1000.0
look(start)
wait_until(lambda: abs((place_at(start + 5.0) or 0) + 0.2) < 0.02, "the correction of the last scan")
answer = {"correction": place_at(start + 5.0)}
last = rospy.Time.from_sec(start + 5.0)
wait_until(lambda: buffer.can_transform("map", "base_link", last), "the last odometry")  # from another publisher
answer["frame"] = buffer.lookup_transform("map", "base_link", last).header.frame_id
answer["saved"] = rospy.ServiceProxy("mapper/save_map", Trigger)().success
grid = rospy.ServiceProxy("dynamic_map", GetMap)().map
cells = np.array(grid.data, np.int8).reshape(grid.info.height, grid.info.width)
answer["size"] = [grid.info.width * grid.info.resolution, grid.info.height * grid.info.resolution]
answer["walls"], answer["known"] = int((cells >= 65).sum()), float((cells >= 0).mean())
wait_until(lambda: maps and metadata, "a map")
answer["published"] = [maps[0].header.frame_id, maps[0].info == metadata[0], len(maps)]
rospy.ServiceProxy("mapper/reset", Empty)()
answer["after_reset"] = len(rospy.ServiceProxy("dynamic_map", GetMap)().map.data)
answer["saved_nothing"] = rospy.ServiceProxy("mapper/save_map", Trigger)().message
maps.clear()
look(start + 100)
wait_until(lambda: maps, "a map after the reset")

def look_after_a_jump():  # a mapper that gets the transforms before the clock takes them for old ones
    look(start)  # time jumps back
    return len(maps) > 1 and maps[-1].header.stamp.to_sec() <= start + 5

wait_until(look_after_a_jump, "a map after the jump")
print(json.dumps(answer))
"""

SCANS_THAT_WAITED = """
from std_msgs.msg import Header
from tf2_msgs.msg import TFMessage
corrections = []

def note(message):
    corrections.extend(t.header.stamp.to_sec() for t in message.transforms if t.header.frame_id == "late_map")

rospy.Subscriber("/tf", TFMessage, note)
scans = rospy.Publisher("scan", LaserScan, queue_size=100)
transforms = tf2_ros.TransformBroadcaster()
wait_until(scans.get_num_connections, "the mapper")
wait_until(lambda: transforms.pub_tf.get_num_connections() > 1, "the subscribers of transforms")
for i in range(50):
    scan = LaserScan(header=Header(stamp=rospy.Time(2000, 10_000_000 * i), frame_id="late_base"))
    scan.angle_min, scan.angle_max, scan.angle_increment, scan.range_max = -1.0, 1.0, 0.5, 20.0
    scan.ranges = [2.0] * 5
    scans.publish(scan)
time.sleep(0.5)  # until all wait
assert not corrections
for seconds in (2000, 2001):
    place = TransformStamped(header=Header(stamp=rospy.Time(seconds), frame_id="late_odom"), child_frame_id="late_base")
    place.transform.rotation.w = 1.0
    transforms.sendTransform(place)
wait_until(lambda: len(corrections) >= 50, "the corrections")
print(json.dumps(corrections == sorted(corrections)))
"""


@pytest.fixture(autouse=True, scope="module")
def _simulated_time(core: RosCore) -> None:
    core.set_param("/use_sim_time", True)


def test_scans_become_a_map_and_odometry_is_put_right(node: Start, ask: Ask, tmp_path: Path) -> None:
    node("mapper", f"_map_file:={tmp_path}/made/room", "_linearUpdate:=0.2", "_map_update_interval:=100")
    seen = ask(MAPPING)
    assert seen["correction"] == pytest.approx(-0.2, abs=0.02)  # odometry 2.2 m, robot 2 m
    assert seen["frame"] == "map"
    assert seen["size"] == pytest.approx([8.0, 6.0], abs=0.3)
    assert seen["walls"] > 500  # 28 m of walls
    assert seen["known"] > 0.9
    assert seen["published"] == ["map", True, 1]
    assert seen["saved"]
    assert read_map(tmp_path / "made" / "room.yaml").occupied.sum() == seen["walls"]
    assert seen["after_reset"] == 0
    assert "no map yet" in seen["saved_nothing"]


def test_scans_that_waited_for_their_transform_are_mapped_in_their_order(node: Start, ask: Ask) -> None:
    frames = [f"_{name}_frame:=late_{name}" for name in ("base", "odom", "map")]
    node("mapper", *frames, "__ns:=/late")
    assert ask(SCANS_THAT_WAITED, "__ns:=/late")


def test_a_mapper_of_nonsense_is_refused(node: Start, core: RosCore) -> None:
    mapper = node("mapper", "_delta:=-1.0", "__ns:=/nonsense", stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    output, _ = mapper.communicate(timeout=3 * DEADLINE)
    assert mapper.returncode == 2
    assert "cell size" in output
    wait_until(lambda: "/nonsense/mapper" not in core.nodes(), "the node to be gone")
