# SPDX-License-Identifier: BSD-3-Clause
"""The nodes that convert clouds and depth images to scans: topics, frames, subscribers, parameters."""

import subprocess

import pytest

from node_types import Ask, Start
from ros_support import RosCore, wait_until

CLOUD_SEEN_THROUGH_TF = """
from sensor_msgs import point_cloud2
from std_msgs.msg import Header
scans = []
rospy.Subscriber("/placed/scan", LaserScan, scans.append)
clouds = rospy.Publisher("/placed/cloud", PointCloud2, queue_size=10)
transforms = tf2_ros.TransformBroadcaster()
stamps = []

def send():  # the cloud comes first, so the node must wait for its transform
    now = rospy.Time.now()
    stamps.append(now.to_nsec())
    points = [(2.0, 0.0, 0.0), (3.0, 0.0, 0.0), (0.0, 1.0, 0.0), (1.0, 0.0, 5.0)]
    clouds.publish(point_cloud2.create_cloud_xyz32(Header(stamp=now, frame_id="lidar"), points))
    time.sleep(0.1)
    transform = TransformStamped(header=Header(stamp=now, frame_id="base"), child_frame_id="lidar")
    transform.transform.translation.x = 0.5
    transform.transform.translation.z = 0.3
    transform.transform.rotation.w = 1.0
    transforms.sendTransform(transform)
    return bool(scans)

wait_until(send, "a scan")
scan = scans[0]
hits = {i: round(r, 4) for i, r in enumerate(scan.ranges) if math.isfinite(r)}
known = scan.header.stamp.to_nsec() in stamps
print(json.dumps({"frame": scan.header.frame_id, "known": known, "hits": hits, "rays": len(scan.ranges)}))
"""

CLOUDS_THAT_WAITED = """
from sensor_msgs import point_cloud2
from std_msgs.msg import Header
scans = []
rospy.Subscriber("/late/scan", LaserScan, scans.append)
clouds = rospy.Publisher("/late/cloud", PointCloud2, queue_size=100)
transforms = tf2_ros.TransformBroadcaster()
wait_until(clouds.get_num_connections, "the node")
wait_until(transforms.pub_tf.get_num_connections, "the subscriber of transforms")
stamps = [rospy.Time.now() + rospy.Duration.from_sec(0.001 * i) for i in range(100)]
for stamp in stamps:
    clouds.publish(point_cloud2.create_cloud_xyz32(Header(stamp=stamp, frame_id="lidar"), [(2.0, 0.0, 0.0)]))
time.sleep(0.5)  # until all wait
assert not scans
for stamp in (stamps[0], stamps[-1] + rospy.Duration(1)):
    transform = TransformStamped(header=Header(stamp=stamp, frame_id="base"), child_frame_id="lidar")
    transform.transform.rotation.w = 1.0
    transforms.sendTransform(transform)
wait_until(lambda: len(scans) >= len(stamps), "the scans")
print(json.dumps([scan.header.stamp for scan in scans] == stamps))
"""

DEPTH_IMAGE = """
from std_msgs.msg import Header
scans = []
rospy.Subscriber("/eye/scan", LaserScan, scans.append)
images = rospy.Publisher("/eye/image", Image, queue_size=10)
cameras = rospy.Publisher("/eye/camera_info", CameraInfo, queue_size=10)

def send():
    header = Header(stamp=rospy.Time.now(), frame_id="camera_optical")
    pixels = np.full((8, 16), 2.0, np.float32)
    images.publish(Image(header=header, width=16, height=8, encoding="32FC1", step=64, data=pixels.tobytes()))
    cameras.publish(CameraInfo(header=header, width=16, height=8, K=[10, 0, 7.5, 0, 10, 3.5, 0, 0, 1]))
    time.sleep(0.1)
    return bool(scans)

wait_until(send, "a scan")
scan = scans[0]
print(json.dumps({"frame": scan.header.frame_id, "left": scan.ranges[-1], "angle": scan.angle_max}))
"""


def test_a_cloud_becomes_a_scan_in_the_target_frame(node: Start, ask: Ask) -> None:
    names = ["cloud_in:=/placed/cloud", "scan:=/placed/scan", "__name:=placed"]
    node("pointcloud_to_laserscan", *names, "_target_frame:=base", "_max_height:=1.0")
    seen = ask(CLOUD_SEEN_THROUGH_TF)
    assert (seen["frame"], seen["known"], seen["rays"]) == ("base", True, 360)
    # 2.5 m ahead; the point to the left is at (0.5, 1): 63.4 degrees, 1.118 m. Rays start at -180 degrees.
    assert seen["hits"] == {"180": 2.5, "243": pytest.approx(1.118, abs=1e-3)}


def test_clouds_that_waited_for_a_transform_become_scans_in_their_order(node: Start, ask: Ask) -> None:
    names = ["cloud_in:=/late/cloud", "scan:=/late/scan", "__name:=late"]
    node("pointcloud_to_laserscan", *names, "_target_frame:=base", "_queue_size:=100")
    assert ask(CLOUDS_THAT_WAITED)


def test_a_depth_image_becomes_a_scan_in_the_frame_that_is_asked_for(node: Start, ask: Ask) -> None:
    node("depthimage_to_laserscan", "__ns:=/eye", "_output_frame_id:=eye_link")
    seen = ask(DEPTH_IMAGE)
    assert seen["frame"] == "eye_link"
    assert seen["left"] == pytest.approx(2.5)  # 2 m ahead and 1.5 m to the left
    assert seen["angle"] == pytest.approx(0.6435, abs=1e-4)  # atan(0.75)


def test_clouds_are_only_listened_to_while_the_scan_is(node: Start, core: RosCore) -> None:
    node("pointcloud_to_laserscan", "cloud_in:=/lazy/cloud", "scan:=/lazy/scan", "__name:=lazy")
    wait_until(lambda: "/lazy/scan" in core.state()["publishers"], "the node")
    assert "/lazy/cloud" not in core.state()["subscribers"]
    listener = subprocess.Popen(["rostopic", "echo", "/lazy/scan"], env=core.env, stdout=subprocess.DEVNULL)
    wait_until(lambda: core.state()["subscribers"].get("/lazy/cloud") == ["/lazy"], "the node to listen")
    listener.terminate()
    listener.wait()
    wait_until(lambda: "/lazy/cloud" not in core.state()["subscribers"], "the node to stop listening")


@pytest.mark.parametrize(
    ("program", "argument", "named"),
    [
        ("pointcloud_to_laserscan", "_angle_increment:=0.0", "angle_increment"),
        ("pointcloud_to_laserscan", "_range_min:=near", "range_min"),
        ("pointcloud_to_laserscan", "_max_height:=-1e400", "max_height"),
        ("depthimage_to_laserscan", "_scan_height:=0", "scan_height"),
    ],
)
def test_parameters_that_cannot_be_are_reported(node: Start, program: str, argument: str, named: str) -> None:
    run = node(program, argument, "__ns:=/wrong", stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    output, _ = run.communicate(timeout=60)
    assert run.returncode == 2
    assert "invalid parameter of" in output
    assert named in output
