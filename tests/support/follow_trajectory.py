#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Sends a goal of the action follow_joint_trajectory by actionlib; prints its end as JSON.

Arguments: namespace of the controller, then a JSON object: names; points [[time, positions, velocities or null]...];
stamp, the time of the start in s, or null; cancel_after in s of simulation time or null; path, a tolerance of all
joints, or null.
"""

import json
import sys
import time

import actionlib
import rospy
from control_msgs.msg import FollowJointTrajectoryAction, FollowJointTrajectoryGoal, JointTolerance
from sensor_msgs.msg import JointState
from trajectory_msgs.msg import JointTrajectoryPoint


def main() -> None:
    controller, text = rospy.myargv(sys.argv)[1:]
    wanted = json.loads(text)
    rospy.init_node("follow_trajectory")
    states: list[JointState] = []
    rospy.Subscriber("/joint_states", JointState, states.append, queue_size=1000)
    client = actionlib.SimpleActionClient(f"{controller}/follow_joint_trajectory", FollowJointTrajectoryAction)
    while not rospy.get_time():  # before the first message of /clock it is 0: a timeout would be over with that message
        time.sleep(0.01)
    assert client.wait_for_server(rospy.Duration(60))
    goal = FollowJointTrajectoryGoal()
    goal.trajectory.joint_names = wanted["names"]
    goal.trajectory.header.stamp = rospy.Time(wanted.get("stamp") or 0)
    for after, positions, velocities in wanted["points"]:
        point = JointTrajectoryPoint(positions=positions, velocities=velocities or [])
        point.time_from_start = rospy.Duration(after)
        goal.trajectory.points.append(point)
    if wanted.get("path"):
        goal.path_tolerance = [JointTolerance(name=name, position=wanted["path"]) for name in wanted["names"]]
    feedback: list[float] = []
    begin = rospy.get_time()
    client.send_goal(goal, feedback_cb=lambda message: feedback.append(max(map(abs, message.error.positions))))
    if wanted.get("cancel_after"):
        rospy.sleep(wanted["cancel_after"])
        client.cancel_goal()
    client.wait_for_result(rospy.Duration(60))
    end = rospy.get_time()
    result = client.get_result()
    while not states or states[-1].header.stamp.to_sec() < end:  # on a busy machine they come later than the result
        time.sleep(0.01)
    last = states[-1]
    print(
        json.dumps(
            {
                "state": client.get_state(),
                "error_code": result.error_code if result else None,
                "error_string": result.error_string if result else None,
                "largest_error": max(feedback, default=0.0),
                "took": end - begin,
                "positions": dict(zip(last.name, last.position, strict=True)),
            }
        ),
        flush=True,
    )


if __name__ == "__main__":
    main()
