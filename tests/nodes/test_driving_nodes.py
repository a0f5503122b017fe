# SPDX-License-Identifier: BSD-3-Clause
"""The navigation nodes, with a robot that follows each command at once."""

import subprocess

import pytest

from node_types import Ask, Start
from ros_support import DEADLINE

# Publishes map, scan and robot: a room of 6 by 4 m with the robot at (1, 2). Arguments: namespace, "goal" to send one.
ROBOT = """
from std_msgs.msg import Bool, Header
namespace, sends_goal = sys.argv[1], sys.argv[2] == "goal"
cells = np.zeros((40, 60), np.int8)
cells[[0, -1], :] = cells[:, [0, -1]] = 100
if not sends_goal:
    cells[:, 40:] = -1  # unknown cells
grid = OccupancyGrid(header=Header(frame_id="map"), data=cells.ravel().tolist())
grid.info.width, grid.info.height, grid.info.resolution = 60, 40, 0.1
grid.info.origin.orientation.w = 1.0

arrived, paths, goals, done, commands = [], [], [], [], []
rospy.Subscriber(namespace + "/go_to/arrived", Bool, arrived.append)
rospy.Subscriber(namespace + "/go_to/path", Path, paths.append)
rospy.Subscriber(namespace + "/move_base_simple/goal", PoseStamped, goals.append)
rospy.Subscriber(namespace + "/explore/done", Bool, done.append)
rospy.Subscriber(namespace + "/cmd_vel", Twist, commands.append)
maps = rospy.Publisher(namespace + "/map", OccupancyGrid, queue_size=1, latch=True)
scans = rospy.Publisher(namespace + "/scan", LaserScan, queue_size=1)
goal_topic = rospy.Publisher(namespace + "/move_base_simple/goal", PoseStamped, queue_size=1)
transforms = tf2_ros.TransformBroadcaster()
x, y, heading = 1.0, 2.0, 0.0
followed = 0  # commands
last_map = 0.0

def live():
    global x, y, heading, followed, last_map, sends_goal
    # Each command moves it for the time between two: without commands, on a busy machine, it must not drive on.
    for command in commands[followed:]:
        followed += 1
        heading += 0.1 * command.angular.z
        x, y = x + 0.1 * command.linear.x * math.cos(heading), y + 0.1 * command.linear.x * math.sin(heading)
    place = TransformStamped(header=Header(stamp=rospy.Time.now(), frame_id="map"), child_frame_id="base_link")
    place.transform.translation.x, place.transform.translation.y = x, y
    place.transform.rotation.z, place.transform.rotation.w = math.sin(heading / 2), math.cos(heading / 2)
    transforms.sendTransform(place)
    scans.publish(LaserScan(header=Header(frame_id="base_link"), ranges=[math.inf] * 4, angle_increment=1.0))
    if time.monotonic() - last_map > 0.5:
        if x > 2.5:
            cells[1:-1, 40:-1] = 0  # the rest is visible from there
            cells[:, -1] = 100
            grid.data = cells.ravel().tolist()
        maps.publish(grid)
        last_map = time.monotonic()
    if sends_goal and goal_topic.get_num_connections() > 1:
        goal = PoseStamped(header=Header(frame_id="map"))
        goal.pose.position.x, goal.pose.position.y, goal.pose.orientation.z = 4.0, 1.0, 1.0
        goal_topic.publish(goal)
        sends_goal = False
    time.sleep(0.04)
    # Topics have no common order: the last command and the path may come after the end of their goal.
    if len(sys.argv) > 3:
        return bool(done and goals and paths)
    return bool(arrived and paths and commands[-1].linear.x == commands[-1].angular.z == 0.0)

wait_until(live, "the end")
print(json.dumps({
    "arrived": [m.data for m in arrived], "place": [x, y, math.cos(heading)], "goals": len(goals), "done": bool(done),
    "path": max(len(path.poses) for path in paths), "frame": paths[0].header.frame_id,
    "last": [commands[-1].linear.x, commands[-1].angular.z],
}))
"""


def test_a_goal_is_driven_to(node: Start, ask: Ask) -> None:
    node("go_to.py", "__ns:=/a", "_max_speed:=1.0", "_acceleration:=1.0")
    seen = ask(ROBOT, "/a", "goal")
    assert seen["arrived"] == [True]
    assert seen["place"][:2] == pytest.approx([4.0, 1.0], abs=0.15)
    assert seen["place"][2] == pytest.approx(-1.0, abs=0.05)  # it faces back, as in the goal
    assert seen["path"] > 20
    assert (seen["frame"], seen["last"]) == ("map", [0.0, 0.0])


def test_what_is_unknown_is_explored(node: Start, ask: Ask) -> None:
    node("go_to.py", "__ns:=/b", "_max_speed:=1.0", "_acceleration:=1.0")
    node("explore.py", "__ns:=/b")
    seen = ask(ROBOT, "/b", "no goal", "until done")
    assert seen["done"]
    assert seen["goals"] >= 1
    assert seen["place"][0] > 2.5


def test_a_robot_that_cannot_be_is_refused(node: Start) -> None:
    run = node("go_to.py", "_max_speed:=-1.0", "__ns:=/c", stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    output, _ = run.communicate(timeout=3 * DEADLINE)
    assert run.returncode == 2
    assert "max_speed is -1.0" in output
    assert "Traceback" not in output
