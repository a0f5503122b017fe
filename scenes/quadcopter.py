#python
# SPDX-License-Identifier: BSD-3-Clause
# Takes off, hovers at 1 m and follows commands: /cmd_vel (Twist, in the frame of the heading) moves the place to hover
# at, /goal (PoseStamped, frame odom) sets it. Publishes /odom, /joint_states and /tf. The state is the true one.
import math

from bubblesim import ros_messages
from bubblesim.controllers.multicopter import Airframe, Goal, MulticopterControl, State
from bubblesim.geometry.frames import into
from bubblesim.geometry.rotations import heading_of

TIMEOUT = 0.6  # s without a Twist after which it hovers
SLOWDOWN = 10.0  # of the rotors' joints: see the model
GROUND = 0.06  # m, height of base_link on the ground


def sysCall_init():
    self.body = sim.getObject('./base_link')
    self.rotors = [sim.getObject(f'./rotor_{i}_joint') for i in range(4)]
    self.airframe = Airframe()
    restart()
    if simROS:
        simROS.subscribe('/cmd_vel', 'geometry_msgs/Twist', on_velocity)
        simROS.subscribe('/goal', 'geometry_msgs/PoseStamped', on_goal)
        self.odometry_topic = simROS.advertise('/odom', 'nav_msgs/Odometry')
        self.joints_topic = simROS.advertise('/joint_states', 'sensor_msgs/JointState')


def sysCall_reset():
    restart()


def restart():
    self.control = MulticopterControl(self.airframe)
    x, y, _ = sim.getObjectPosition(self.body)
    self.goal = Goal([x, y, 1.0], heading=heading())
    self.last_command = None  # its time; None while it hovers


def heading():
    return heading_of(*sim.getObjectQuaternion(self.body))


def on_velocity(twist):
    linear, yaw_rate = ros_messages.vector_values(twist['linear']), twist['angular']['z']
    if all(map(math.isfinite, (*linear, yaw_rate))):
        self.last_command = sim.getSimulationTime()
        self.goal = self.goal.moving(linear, yaw_rate)


def on_goal(message):
    x, y, z, *turn = ros_messages.pose_values(message['pose'])
    self.last_command = None
    self.goal = Goal([x, y, max(z, GROUND)], heading=heading_of(*turn))


def sysCall_actuation():
    if self.last_command is not None and sim.getSimulationTime() - self.last_command > TIMEOUT:
        self.last_command = None
        self.goal = self.goal.at_rest()
    dt = sim.getSimulationTimeStep()
    self.goal = self.goal.after(dt, lowest=GROUND)
    linear, angular = sim.getObjectVelocity(self.body)
    state = State(sim.getObjectPosition(self.body), sim.getObjectQuaternion(self.body), linear, angular)
    for joint, speed in zip(self.rotors, self.control.update(state, self.goal, dt), strict=True):
        sim.setJointTargetVelocity(joint, speed / SLOWDOWN)


def sysCall_sensing():
    if not simROS:
        return
    now = simROS.getTime()
    pose = sim.getObjectPose(self.body)
    simROS.sendTransform(ros_messages.transform(now, 'odom', 'base_link', pose))
    if simROS.wantsMessages(self.odometry_topic):
        linear, angular = (into(pose, velocity) for velocity in sim.getObjectVelocity(self.body))
        odometry = ros_messages.odometry(now, 'odom', 'base_link', pose=pose, linear=linear, angular=angular)
        simROS.publish(self.odometry_topic, odometry)
    if simROS.wantsMessages(self.joints_topic):
        states = {sim.getObjectAlias(j): (sim.getJointPosition(j), sim.getJointVelocity(j)) for j in self.rotors}
        simROS.publish(self.joints_topic, ros_messages.joint_state(now, states))
