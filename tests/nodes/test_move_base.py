# SPDX-License-Identifier: BSD-3-Clause
"""The action of move_base, with a robot that follows each command at once."""

import pytest

from bubblesim.compat.move_base import driver_parameters
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


def test_parameters_that_mean_the_same_are_passed_on() -> None:
    given = {
        "global_costmap": {"global_frame": "map", "robot_base_frame": "base_footprint"},
        "local_costmap": {"robot_radius": 0.2},
        "DWAPlannerROS": {"max_vel_trans": 0.4, "max_vel_theta": 1.2, "sim_time": 1.7},
    }
    assert driver_parameters(given) == {
        "map_frame": "map",
        "base_frame": "base_footprint",
        "radius": 0.2,
        "max_speed": 0.4,
        "max_turn": 1.2,
    }
