# SPDX-License-Identifier: BSD-3-Clause
"""The tricycle's camera, GPS receiver and odometry on their topics."""

import math
from pathlib import Path

import pytest

from node_support import Node, findings_of, run_script
from ros_support import REPOSITORY, RosCore

PROBE = """
import json
import rospy
from nav_msgs.msg import Odometry
from sensor_msgs.msg import CameraInfo, Image, JointState, NavSatFix
from std_msgs.msg import Float32

rospy.init_node('probe')
speed = rospy.Publisher('/speed', Float32, queue_size=1, latch=True)
steering = rospy.Publisher('/steering', Float32, queue_size=1, latch=True)
speed.publish(2.0)
steering.publish(0.3)
while rospy.wait_for_message('/odom', Odometry).pose.pose.orientation.z < 0.2:
    pass
speed.publish(0.0)
while abs(rospy.wait_for_message('/odom', Odometry).twist.twist.linear.x) > 1e-4:
    pass
odom = rospy.wait_for_message('/odom', Odometry)
fix = rospy.wait_for_message('/fix', NavSatFix)
image = rospy.wait_for_message('/image', Image)
info = rospy.wait_for_message('/camera_info', CameraInfo)
joints = rospy.wait_for_message('/joint_states', JointState)
print(json.dumps({
    'odom': [odom.pose.pose.position.x, odom.pose.pose.position.y, odom.pose.pose.orientation.z],
    'frames': [odom.header.frame_id, odom.child_frame_id, fix.header.frame_id, image.header.frame_id],
    'fix': [fix.latitude, fix.longitude, fix.altitude],
    'image': [image.width, image.height, image.encoding, len(image.data), len(set(image.data))],
    'info': [info.width, info.height, info.K[0], info.K[2], info.P[5]],
    'joints': dict(zip(joints.name, joints.position)),
}))
"""


def test_their_readings_agree(roscore: RosCore, tmp_path: Path) -> None:
    roscore.set_param("/use_sim_time", True)
    with Node(roscore.env, tmp_path / "log", "tricycle", "--speed", "2") as node:
        found = findings_of(PROBE, roscore.env, tmp_path)
        assert node.end() == 0
    assert found["frames"] == ["odom", "base_link", "Gps", "Camera_optical"]
    # A degree of latitude at 48 degrees north is 111 194 m, a degree of longitude 74 395 m (WGS84). x is east, and the
    # receiver is at base_link; its noise has a standard deviation of 2 cm.
    x, y, _ = found["odom"]
    latitude, longitude, altitude = found["fix"]
    assert (longitude - 11.575) * 74_395 == pytest.approx(x, abs=0.12)
    assert (latitude - 48.137) * 111_194 == pytest.approx(y, abs=0.12)
    assert altitude == pytest.approx(520.93, abs=0.2)
    width, height, encoding, size, levels = found["image"]
    assert (width, height, encoding, size) == (320, 240, "rgb8", 320 * 240 * 3)
    assert levels > 20
    assert found["info"] == pytest.approx([320, 240, 160 / math.tan(0.6), 159.5, 160 / math.tan(0.6)])
    assert found["joints"]["Steering"] == pytest.approx(0.3, abs=0.01)
    assert set(found["joints"]) == {"Steering", "FrontMotor", "RearLeftAxle", "RearRightAxle"}


def test_its_odometry_stays_with_it(tmp_path: Path) -> None:
    code = """\
        include tricycle

        def sysCall_actuation():
            sim.setJointTargetPosition(self.steering, -0.5 if sim.getSimulationTime() > 3 else 0.4)
            sim.setJointTargetVelocity(self.motor, min(3.0, sim.getSimulationTime()))  # below the limit of slip

        def sysCall_sensing():
            move_odometry()
            x, y, _ = sim.getObjectPosition(self.body)
            off = math.hypot(self.pose.x - x, self.pose.y - y)
            assert off < 0.03, (sim.getSimulationTime(), off)
        """
    run = run_script(
        tmp_path,
        code,
        "--strict",
        "--script-path",
        str(REPOSITORY / "scenes"),
        scene="tricycle",
        target="/Tricycle",
        until=6.0,
    )
    assert (run.stderr, run.returncode) == ("", 0)
