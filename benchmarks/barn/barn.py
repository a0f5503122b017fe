# SPDX-License-Identifier: BSD-3-Clause
"""The BARN navigation challenge with go_to's navigation, as a sweep:

    export BARN_WORLDS=FOLDER
    bubblesim sweep benchmarks/barn/barn.py --set world=0:294:6 --seeds 0:10 --output barn.csv

The robot knows nothing of the world: it maps what its lidar sees, at the poses of its odometry, and drives towards a
goal 10 m ahead. Scoring of the challenge: success within 1 m of the goal in 100 s without a contact,
metric = success * T / clip(t, 2 T, 8 T), T: time of the reference path at 2 m/s.
"""

import math
import random

from bubblesim.controllers.differential_drive import DifferentialDrive, WheelOdometry, Wheels, wheel_speeds
from bubblesim.controllers.planar_motion import Pose2D
from bubblesim.navigation.driver import STANDING, Driver
from bubblesim.navigation.driving import Driving, GaveUpError
from bubblesim.navigation.local_planning import Body
from bubblesim.navigation.path_planning import Footprint
from bubblesim.navigation.planar import hits
from bubblesim.navigation.scan_map import ScanMap
from bubblesim.sweeps.programs import Run
from worlds import GOAL, START, optimal_time, scene_of

DRIVE = DifferentialDrive(wheel_radius=0.098, track=0.376, max_speed=2.0 / 0.098)
LIDAR = Pose2D(0.12, 0.0, 0.0)  # in the robot's frame
MOST_CHANGE = 3.0 / 0.098 * 0.05  # rad/s in a step: the base accelerates each wheel by 3 m/s2 at most
TIMEOUT = 100.0  # s
REACHED = 1.0  # m
ENCODER_NOISE = 0.02  # standard deviation of each increment, as a fraction of it


def run(run: Run) -> dict[str, float | bool | str]:
    """Drive through the world of the parameter `world`."""
    world = int(run.parameters["world"])
    simulation = run.simulation(scene_of(world))
    robot, bumper, lidar = (simulation.object(path) for path in ("/Jackal", "/Bumper", "/FrontLidar"))
    motors = simulation.object("/LeftMotor"), simulation.object("/RightMotor")
    noise = random.Random(run.seed)

    def angles() -> Wheels:
        return Wheels(*(motor.joint_position for motor in motors))

    odometry = WheelOdometry(DRIVE, angles(), lambda: noise.gauss(0.0, ENCODER_NOISE))
    odometry.pose = Pose2D(*START)
    driving = Driving(
        Driver(max_speed=1.3, max_turn=2.5, acceleration=1.5, lookahead=0.8, radius=0.25, tolerance=0.2),
        Footprint(radius=0.21, comfort=0.6),
        timeout=10.0,
        body=Body.rectangle(length=0.508, width=0.43),
    )
    scans = ScanMap(resolution=0.05, corner=(-6.0, 1.0), size=(8.0, 14.0))
    driving.start(GOAL, 0.0)
    outcome, command = "timeout", STANDING
    while simulation.time < TIMEOUT:
        simulation.step()
        odometry.update(angles(), simulation.time_step)
        x, y, _ = robot.position
        if bumper.reading.contacts:
            outcome = "collision"
            break
        if math.dist((x, y), GOAL) < REACHED:
            outcome = "success"
            break
        scan = lidar.reading
        driving.obstacles = hits(_Scan(scan), LIDAR)
        scans.add(odometry.pose, driving.obstacles)
        driving.grid = scans.grid
        try:
            command = driving.update(odometry.pose, simulation.time) or STANDING
        except GaveUpError:
            outcome = "gave up"
            break
        speeds = wheel_speeds(DRIVE, command)
        for motor, wanted in zip(motors, (speeds.left, speeds.right), strict=True):
            now = motor.target_velocity
            motor.target_velocity = now + min(max(wanted - now, -MOST_CHANGE), MOST_CHANGE)
    optimal = optimal_time(world)
    success = outcome == "success"
    metric = success * optimal / min(max(simulation.time, 2 * optimal), 8 * optimal)
    return {"success": success, "collision": outcome == "collision", "time": simulation.time, "metric": metric}


class _Scan:
    """A lidar scan with the fields of sensor_msgs/LaserScan."""

    def __init__(self, scan) -> None:
        self.ranges = scan.ranges[0]
        self.angle_min, self.angle_increment = scan.angle_min, scan.angle_increment
        self.range_min, self.range_max = scan.min_range, scan.max_range
