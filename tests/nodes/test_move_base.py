# SPDX-License-Identifier: BSD-3-Clause
"""The action of move_base, with a robot that follows each command at once."""

import math

import pytest

from node_types import Ask, Start

# A room of 6 by 4 m with the robot at (1, 2); goals by the action: one that is reached, one that is cancelled, one in a
# wall. Prints the states at their ends, and where the robot is.
ROBOT = """
import actionlib, threading
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal
from std_msgs.msg import Header
cells = np.zeros((40, 60), np.int8)
cells[[0, -1], :] = cells[:, [0, -1]] = 100
grid = OccupancyGrid(header=Header(frame_id="map"), data=cells.ravel().tolist())
grid.info.width, grid.info.height, grid.info.resolution = 60, 40, 0.1
grid.info.origin.orientation.w = 1.0
commands = []
rospy.Subscriber("/cmd_vel", Twist, commands.append)
maps = rospy.Publisher("/map", OccupancyGrid, queue_size=1, latch=True)
scans = rospy.Publisher("/scan", LaserScan, queue_size=1)
transforms = tf2_ros.TransformBroadcaster()
place = [1.0, 2.0, 0.0]

def live():
    followed = 0
    while not rospy.is_shutdown():
        for command in commands[followed:]:
            followed += 1
            place[2] += 0.1 * command.angular.z
            place[0] += 0.1 * command.linear.x * math.cos(place[2])
            place[1] += 0.1 * command.linear.x * math.sin(place[2])
        sent = TransformStamped(header=Header(stamp=rospy.Time.now(), frame_id="map"), child_frame_id="base_link")
        sent.transform.translation.x, sent.transform.translation.y = place[:2]
        sent.transform.rotation.z, sent.transform.rotation.w = math.sin(place[2] / 2), math.cos(place[2] / 2)
        transforms.sendTransform(sent)
        scans.publish(LaserScan(header=Header(frame_id="base_link"), ranges=[math.inf] * 4, angle_increment=1.0))
        maps.publish(grid)
        time.sleep(0.05)

threading.Thread(target=live, daemon=True).start()
client = actionlib.SimpleActionClient("/move_base", MoveBaseAction)
assert client.wait_for_server(rospy.Duration(60))
wait_until(lambda: scans.get_num_connections() > 0, "the driver")
time.sleep(1.0)
feedback = []

def send(x, y):
    goal = MoveBaseGoal()
    goal.target_pose.header.frame_id = "map"
    goal.target_pose.pose.position.x, goal.target_pose.pose.position.y = x, y
    goal.target_pose.pose.orientation.w = 1.0
    client.send_goal(goal, feedback_cb=feedback.append)

send(4.0, 1.0)
client.wait_for_result(rospy.Duration(60))
reached, at = client.get_state(), list(place)
send(1.0, 3.0)
wait_until(lambda: place[0] < 3.5, "it to drive")
client.cancel_goal()
client.wait_for_result(rospy.Duration(60))
cancelled = client.get_state()
time.sleep(2.0)
before = list(place)
time.sleep(1.0)
print(json.dumps({"reached": reached, "at": at, "cancelled": cancelled, "moved": math.dist(before[:2], place[:2]),
                  "place": place, "feedback": feedback[0].base_position.header.frame_id}))
"""
# The same room with a post at (3, 2): paths around it, and the costmaps.
PLANS = (
    ROBOT.split("client = ")[0]
    .replace("grid = ", "cells[18:22, 28:32] = 100\ngrid = ", 1)
    .replace("[math.inf] * 4", "[1.02] + [math.inf] * 3, range_max=10.0")
    + """
from nav_msgs.srv import GetPlan, GetPlanRequest
rospy.wait_for_service("/move_base/make_plan", 60)
make_plan = rospy.ServiceProxy("/move_base/make_plan", GetPlan)

def path(goal, start=None):
    request = GetPlanRequest()
    request.goal.header.frame_id = "map"
    request.goal.pose.position.x, request.goal.pose.position.y = goal
    if start:
        request.start.header.frame_id = "map"
        request.start.pose.position.x, request.start.pose.position.y = start
    return [(pose.pose.position.x, pose.pose.position.y) for pose in make_plan(request).plan.poses]

wait_until(lambda: path((5.0, 2.0)), "a plan")
costs = {}
for name in ("global_costmap", "local_costmap"):
    message = rospy.wait_for_message(f"/move_base/{name}/costmap", OccupancyGrid, 60)
    columns, side, corner = message.info.width, message.info.resolution, message.info.origin.position
    def cost(x, y):
        return message.data[int((y - corner.y) / side) * columns + int((x - corner.x) / side)]
    places = {"post": (2.95, 1.95), "beside": (2.55, 1.95), "hit": (2.025, 2.025), "away": (1.05, 0.95)}
    costs[name] = {place: cost(*point) for place, point in places.items()}
    costs[name]["size"] = [columns, message.info.height]
print(json.dumps({"from_robot": path((5.0, 2.0)), "between": path((5.0, 2.0), (5.0, 1.0)),
                  "in_wall": path((3.0, 2.0)), "costs": costs}))
"""
)
SUCCEEDED, PREEMPTED = 3, 2  # of actionlib_msgs/GoalStatus


def test_goals_of_the_action_are_driven_to_and_cancelled(node: Start, ask: Ask) -> None:
    node("../compat/move_base/move_base", "_DWAPlannerROS/max_vel_x:=1.0", "_DWAPlannerROS/acc_lim_x:=1.0")
    seen = ask(ROBOT)
    assert seen["reached"] == SUCCEEDED
    assert seen["at"][:2] == pytest.approx([4.0, 1.0], abs=0.2)
    assert seen["cancelled"] == PREEMPTED
    assert seen["moved"] < 0.05
    assert seen["place"][0] > 1.5, "it stopped on its way"
    assert seen["feedback"] == "map"


def test_plans_lead_around_obstacles_and_costmaps_show_them(node: Start, ask: Ask) -> None:
    node(
        "../compat/move_base/move_base",
        "_global_costmap/robot_radius:=0.3",
        "_local_costmap/width:=4.0",
        "_local_costmap/height:=3.0",
    )
    seen = ask(PLANS)
    path = seen["from_robot"]
    assert path[0] == pytest.approx([1.0, 2.0])
    assert path[-1] == pytest.approx([5.0, 2.0])
    assert all(math.dist(point, (3.0, 2.0)) > 0.45 for point in path)
    assert seen["between"][0] == [5.0, 1.0]
    assert seen["in_wall"] == []
    costs = seen["costs"]["global_costmap"]
    assert (costs["size"], costs["post"], costs["beside"], costs["away"]) == ([60, 40], 100, 99, 0)
    local = seen["costs"]["local_costmap"]
    assert local["size"] == [80, 60]
    assert local["hit"] >= 99
    assert local["away"] == 0
