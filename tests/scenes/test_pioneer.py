# SPDX-License-Identifier: BSD-3-Clause
"""The Pioneer P3DX: its drive, and the messages of its script."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import bubblesim
from bubblesim.controllers.differential_drive import DifferentialDrive, wheel_speeds
from bubblesim.controllers.planar_motion import Velocity
from node_support import Node, findings_of, run_script, run_sim, write
from ros_support import RosCore

DRIVE = DifferentialDrive(wheel_radius=0.0975, track=0.33)
FURNITURE = ("Table", "Chair", "Shelf", "Sofa", "CoffeeTable", "Plant", "FloorLamp")


class Pioneer:
    """The Pioneer in its room, without its script."""

    def __init__(self) -> None:
        self.simulation = bubblesim.Simulation("pioneer")
        self.body, self.left, self.right = (
            self.simulation.object(f"/Pioneer_p3dx{part}") for part in ("", "_leftMotor", "_rightMotor")
        )

    def command(self, linear: float, angular: float) -> None:
        wheels = wheel_speeds(DRIVE, Velocity(linear, angular))
        self.left.target_velocity, self.right.target_velocity = wheels.left, wheels.right

    def places(self, steps: int) -> Any:
        """Return x, y after each step."""
        found = []
        for _ in range(steps):
            self.simulation.step()
            found.append(self.body.position[:2].copy())
        return np.array(found)


def test_it_has_the_parts_by_which_scripts_know_it() -> None:
    names = {thing.name for thing in Pioneer().simulation.objects}
    parts = ("leftMotor", "rightMotor", "leftWheel", "rightWheel", "caster_link", "caster_wheel", "lidar")
    assert {f"Pioneer_p3dx_{part}" for part in parts} <= names
    assert all(any(name.startswith(thing) for name in names) for thing in FURNITURE)


def test_it_drives_straight_at_the_commanded_speed() -> None:
    pioneer = Pioneer()
    pioneer.command(0.5, 0.0)
    places = pioneer.places(60)
    assert np.linalg.norm(places[-1] - places[-21]) == pytest.approx(0.5, rel=0.001)
    assert abs(places[-1, 1]) < 1e-3


@pytest.mark.parametrize(("linear", "angular"), [(0.3, 0.6), (0.2, -0.8), (-0.3, 0.6)])
def test_its_circles_have_the_radius_of_the_theory(linear: float, angular: float) -> None:
    pioneer = Pioneer()
    pioneer.command(linear, angular)
    pioneer.places(40)  # the caster turns round
    places = pioneer.places(round(math.tau / abs(angular) / 0.05))
    centre = (places.max(axis=0) + places.min(axis=0)) / 2
    radii = np.linalg.norm(places - centre, axis=1)
    assert radii == pytest.approx(abs(linear / angular), rel=0.01)


def test_its_lidar_sees_the_room_and_not_itself() -> None:
    simulation = bubblesim.Simulation("pioneer")
    points = simulation.object("/Pioneer_p3dx_lidar").reading.points
    assert len(points) > 0.9 * 16 * 720
    distances = np.hypot(points[:, 0], points[:, 1])
    assert distances.min() > 0.25  # m: the robot is smaller
    # Nothing is behind the walls, 4 and 3 m from the middle of the room; noise has a standard deviation of 1 cm.
    assert np.abs(points[:, 0] - 0.0325).max() < 4.0 + 0.06
    assert np.abs(points[:, 1]).max() < 3.0 + 0.06
    assert points[:, 2].min() > -0.31 - 0.06


PROBE = """\
import json
import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from sensor_msgs.msg import JointState, PointCloud2

rospy.init_node('probe')
drive = rospy.Publisher('/cmd_vel', Twist, queue_size=1)
command = Twist()
command.linear.x, command.angular.z = 0.4, 0.5
rospy.Timer(rospy.Duration(0.1), lambda event: drive.publish(command))
odoms, truths = {}, {}  # from the start: the error of a noisy odometry grows with the way
rospy.Subscriber('/odom', Odometry, lambda m: odoms.setdefault(m.header.stamp, m))
rospy.Subscriber('/ground_truth', Odometry, lambda m: truths.setdefault(m.header.stamp, m))

def has_the_speed(truth):
    # A robot that gets no command for a while, from a busy machine, stops and starts again.
    twist = truth.twist.twist
    return truth.pose.pose.position.y > 0.3 and abs(twist.linear.x - 0.4) < 0.004 and abs(twist.angular.z - 0.5) < 0.005

found = []
while not found:
    rospy.sleep(0.05)
    found = [stamp for stamp, truth in sorted(truths.copy().items()) if stamp in odoms and has_the_speed(truth)]
odom, truth = odoms[found[0]], truths[found[0]]
cloud = rospy.wait_for_message('/lidarPC', PointCloud2)
joints = rospy.wait_for_message('/joint_states', JointState)
place = lambda m: [m.pose.pose.position.x, m.pose.pose.position.y, m.pose.pose.orientation.z]
print(json.dumps({'odom': place(odom), 'truth': place(truth), 'frames': [odom.header.frame_id, odom.child_frame_id],
    'speeds': [odom.twist.twist.linear.x, odom.twist.twist.angular.z],
    'true_speeds': [truth.twist.twist.linear.x, truth.twist.twist.angular.z],
    'cloud': [cloud.header.frame_id, cloud.width * cloud.height, cloud.point_step, len(cloud.data)],
    'joints': list(joints.name)}))
"""


@pytest.mark.parametrize("noise", [0.0, 0.2])
def test_it_follows_velocities_and_publishes_its_pose(roscore: RosCore, tmp_path: Path, noise: float) -> None:
    roscore.set_param("/use_sim_time", True)
    roscore.set_param("/sim_ros_interface/odometry_noise", noise)
    with Node(roscore.env, tmp_path / "log", "pioneer", "--speed", "2") as node:
        found = findings_of(PROBE, roscore.env, tmp_path)
        assert node.end() == 0
    assert found["frames"] == ["odom", "base_link"]
    assert found["true_speeds"] == pytest.approx([0.4, 0.5], rel=0.01)
    error = math.dist(found["odom"], found["truth"])
    if noise:
        assert 1e-3 < error < 0.3
    else:
        assert error < 5e-3
        assert found["speeds"] == pytest.approx([0.4, 0.5], rel=0.01)
    frame, points, size, length = found["cloud"]
    assert (frame, size, length) == ("Pioneer_p3dx_lidar", 12, 12 * points)
    assert points > 9000
    assert found["joints"][:2] == ["Pioneer_p3dx_leftMotor", "Pioneer_p3dx_rightMotor"]


SIGNAL_READERS = {
    "script.py": """
        def sysCall_init():
            self.lidar = sim.getObject('/Pioneer_p3dx_lidar')
        def sysCall_sensing():
            data = sim.getStringSignal('Pioneer_p3dx_lidar_data')
            if data:
                assert data == sim.readLidarPoints(self.lidar).tobytes()
                assert data == sim.getStringProperty(sim.handle_scene, 'signal.Pioneer_p3dx_lidar_data')
                print(f'{sim.getSimulationTime():.2f}', *sim.unpackFloatTable(data))
                sim.clearStringSignal('Pioneer_p3dx_lidar_data')
        """,
    "script.lua": """
        function sysCall_init() end
        function sysCall_sensing()
          local data = sim.getStringSignal('Pioneer_p3dx_lidar_data')
          if data then
            print(string.format('%.2f ', sim.getSimulationTime()) .. table.concat(sim.unpackFloatTable(data), ' '))
            sim.clearStringSignal('Pioneer_p3dx_lidar_data')
          end
        end
        """,
}


def test_other_scripts_find_the_points_in_the_signal(tmp_path: Path) -> None:
    code = """
        def sysCall_init():
            self.lidar = sim.getObject('/Pioneer_p3dx_lidar')
        def sysCall_sensing():
            assert sim.getStringSignal('Pioneer_p3dx_lidar_data') == sim.readLidarPoints(self.lidar).tobytes()
            print('equal')
    """
    run = run_script(tmp_path, code, "--strict", scene="pioneer", target="/Table")
    assert (run.stderr, run.returncode) == ("", 0)
    assert run.stdout.splitlines() == ["equal"] * 4


@pytest.mark.parametrize("name", SIGNAL_READERS)
def test_a_script_in_place_of_its_own_finds_the_points_of_its_lidar_in_the_signal(tmp_path: Path, name: str) -> None:
    run = run_script(
        tmp_path, SIGNAL_READERS[name], "--strict", name=name, scene="pioneer", target="/Pioneer_p3dx", until=0.35
    )
    assert (run.stderr, run.returncode) == ("", 0)
    scans = [np.array(line.split(), float) for line in run.stdout.splitlines()]
    # At the ends of steps it measures when it is read first, and at 0.1 s, 0.2 s, ...; none after it was cleared.
    assert [scan[0] + 0.05 for scan in scans] == pytest.approx([0.05, 0.1, 0.2, 0.3])
    for scan in scans:
        points = scan[1:].reshape(-1, 3)
        ranges = np.linalg.norm(points, axis=1)
        assert len(points) > 5000  # of 16 rings of 720
        assert ((ranges > 0.1) & (ranges < 20.1)).all()  # 0.2 to 20 m, and a noise of 1 cm
        elevations = np.degrees(np.arcsin(points[:, 2] / ranges))
        assert np.abs(elevations).max() == pytest.approx(15.0, abs=0.01)


def test_a_script_may_set_the_signal_itself(tmp_path: Path) -> None:
    code = """
        def sysCall_init():
            sim.setStringSignal('Pioneer_p3dx_lidar_data', 'mine')
            print(sim.getStringSignal('Pioneer_p3dx_lidar_data'), sim.getStringSignal(''), sim.getStringSignal('other'))
    """
    run = run_script(tmp_path, code, scene="pioneer", target="/Pioneer_p3dx")
    assert (run.stdout, run.stderr) == ("mine None None\n", "")


def test_the_signal_belongs_to_a_lidar(tmp_path: Path) -> None:
    scene = write(
        tmp_path / "wrong.sdf",
        """\
        <?xml version="1.0"?>
        <sdf version="1.9" xmlns:bubblesim="https://bubblesim">
          <world name="wrong">
            <model name="M">
              <link name="l"><sensor name="s" type="imu"><bubblesim:signal>x</bubblesim:signal></sensor></link>
            </model>
          </world>
        </sdf>
        """,
    )
    run = run_sim(scene, "--no-ros", "--until", "0")
    assert run.returncode == 2
    assert "<bubblesim:signal> is not allowed in <sensor>, it belongs in <lidar>" in run.stderr
