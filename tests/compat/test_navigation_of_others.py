# SPDX-License-Identifier: BSD-3-Clause
"""A Jackal that others published drives through a world of the BARN challenge with move_base, as its run.py lets it.

The order and the parameters are those of the challenge: the robot falls onto the obstacles, is put to its start by a
service, and gets the goal 10 m ahead in the frame of its odometry ten times a second, without a map.
"""

import math
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest

from launch_support import ROBOTS, launched, with_packages
from node_support import write
from process_support import cpu_seconds
from robots_of_others import NOT_MOUNTED, add_packages
from ros_support import DEADLINE, RosCore, wait_until
from service_caller import ServiceCaller

BARN = None if ROBOTS is None else ROBOTS.parent / "barn"
pytestmark = pytest.mark.skipif(
    BARN is None or not BARN.is_dir(), reason="the robots and worlds of others are not there"
)
START = (-2.0, 3.0, math.pi / 2)  # x, y, yaw
GOAL = 10.0  # m ahead
REACHED = 0.3  # m, as run.py has it
TIMEOUT = 100.0  # s
SHARE = 0.15  # of a core that move_base takes
HALF_WIDTH = 0.165  # m, of the robot

SIMULATION = """<launch>
  <include file="$(find gazebo_ros)/launch/empty_world.launch">
    <arg name="gui" value="false"/><arg name="paused" value="true"/><arg name="world_name" value="$(arg world)"/>
  </include>
  <include file="$(find jackal_gazebo)/launch/spawn_jackal.launch">
    <arg name="x" value="0"/><arg name="y" value="0"/><arg name="z" value="1.0"/><arg name="yaw" value="0"/>
    <arg name="config" value="front_laser"/><arg name="joystick" value="false"/>
  </include>
  <arg name="world"/>
</launch>"""
NAVIGATION = """<launch>
  <node pkg="move_base" type="move_base" name="move_base">
    <rosparam>
      controller_frequency: 20.0
      base_local_planner: base_local_planner/TrajectoryPlannerROS
      TrajectoryPlannerROS: {max_vel_x: 0.5, max_vel_theta: 1.57, acc_lim_x: 10.0, xy_goal_tolerance: 0.25,
        yaw_goal_tolerance: 0.157}
      global_costmap: &amp;common
        global_frame: odom
        robot_base_frame: base_link
        footprint: [[-0.21, -0.165], [-0.21, 0.165], [0.21, 0.165], [0.21, -0.165]]
        footprint_padding: 0.1
        plugins: [{name: obstacles_layer, type: "costmap_2d::ObstacleLayer"},
          {name: inflater_layer, type: "costmap_2d::InflationLayer"}]
        obstacles_layer: {observation_sources: scan, scan: {data_type: LaserScan, topic: front/scan}}
        inflater_layer: {inflation_radius: 0.3}
        width: 40.0
        height: 40.0
        origin_x: -20.0
        origin_y: -20.0
        update_frequency: 10
      local_costmap: *common
    </rosparam>
    <remap from="odom" to="odometry/filtered"/>
  </node>
  <node pkg="rostopic" type="rostopic" name="goal" args="pub -r 10 /move_base_simple/goal geometry_msgs/PoseStamped
    '{header: {frame_id: odom}, pose: {position: {y: 10.0}, orientation: {z: 0.7071068, w: 0.7071068}}}'"/>
</launch>"""


def cylinders(world: int) -> list[tuple[float, float, float]]:
    """Return x, y and the radius of the obstacles."""
    found = []
    for each in ElementTree.parse(f"{BARN}/world_{world}.world").getroot().iterfind("./world/model"):
        if radius := each.findtext("./link/collision/geometry/cylinder/radius"):
            x, y = map(float, each.findtext("pose", "0 0 0 0 0 0").split()[:2])
            found.append((x, y, float(radius)))
    return found


@pytest.fixture
def environment(tmp_path: Path) -> Iterator[tuple[RosCore, dict[str, str]]]:
    with RosCore(tmp_path / "roslog") as core:
        assert ROBOTS is not None
        add_packages(tmp_path / "packages", NOT_MOUNTED)
        options = {"BUBBLESIM_GAZEBO_OPTIONS": "--speed 2 --seed 1"}
        yield core, with_packages(core.env, ROBOTS, tmp_path / "packages", **options)


def test_a_jackal_drives_through_a_world_of_barn(
    tmp_path: Path, environment: tuple[RosCore, dict[str, str]], request: pytest.FixtureRequest
) -> None:
    core, env = environment
    simulation = write(tmp_path / "simulation.launch", SIMULATION)
    navigation = write(tmp_path / "navigation.launch", NAVIGATION)
    world = f"world:={BARN}/world_0.world"
    with (
        launched(core, env, tmp_path / "log", str(simulation), world, ready="/odometry/filtered"),
        ServiceCaller(core) as call,
    ):
        state = model(call)
        # Paused until the odometry's filter gets the turns of the robot, which falls onto the obstacles.
        wait_until(lambda: "jackal" in models(call), "the robot", 3 * DEADLINE)
        wait_until(lambda: "/ekf_localization" in subscribers(core, "/imu/data"), "the filter", 3 * DEADLINE)
        time.sleep(1.0)  # until they are connected
        call("/gazebo/unpause_physics")
        core.echo("/odometry/filtered")
        wait_until(lambda: put_to_start(call), "the start", 3 * DEADLINE)
        with launched(core, env, tmp_path / "log2", str(navigation), ready="/move_base/status"):
            wait_until(lambda: math.dist(state(), START[:2]) > 0.1, "it to move", 3 * DEADLINE)
            pid, begin = core.pid_of("/move_base"), simulated(call)
            before = cpu_seconds(pid)
            target = START[0], START[1] + GOAL
            path: list[tuple[float, float]] = []

            def is_there() -> bool:
                path.append(state())
                return math.dist(path[-1], target) < REACHED

            wait_until(is_there, lambda: f"the goal: {path[-1]}", TIMEOUT)
            took = simulated(call) - begin
            assert took < TIMEOUT
            share = (cpu_seconds(pid) - before) / took
            # A core that other programs keep busy needs up to twice the time for the same work.
            assert share < (SHARE if request.config.getoption("--long") else 2 * SHARE), "of a core, at 20 Hz"
            nearest = min(math.dist(place, (x, y)) - radius for place in path for x, y, radius in cylinders(0))
            assert nearest > HALF_WIDTH


def model(call: ServiceCaller) -> Callable[[], tuple[float, float]]:
    def state() -> tuple[float, float]:
        position = call("/gazebo/get_model_state", model_name="jackal")["pose"]["position"]
        return position["x"], position["y"]

    return state


def models(call: ServiceCaller) -> list[str]:
    return list(call("/gazebo/get_world_properties").get("model_names", []))


def subscribers(core: RosCore, topic: str) -> list[str]:
    return core.state()["subscribers"].get(topic, [])


def simulated(call: ServiceCaller) -> float:
    return float(call("/gazebo/get_world_properties")["sim_time"])


def put_to_start(call: ServiceCaller) -> bool:
    """Put the robot to its start, once it is there; as run.py does, at once."""
    pose: dict[str, Any] = {"position": {"x": START[0], "y": START[1], "z": 0.0},
                            "orientation": {"z": math.sin(START[2] / 2), "w": math.cos(START[2] / 2)}}  # fmt: skip
    state = {"model_name": "jackal", "pose": pose, "reference_frame": "world"}
    answer = call("/gazebo/set_model_state", model_state=state)
    return bool(answer.get("success"))
