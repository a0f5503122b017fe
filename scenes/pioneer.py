#python
# SPDX-License-Identifier: BSD-3-Clause
# ROS interface of a Pioneer P3DX. Subscribes to /cmd_vel (Twist); publishes /odom and its transform from the wheel
# encoders, /joint_states, the lidar's points on /lidarPC, and the true pose on /ground_truth.
# Parameter odometry_noise: standard deviation of each encoder increment, as a fraction of that increment.
import random

from bubblesim import ros_messages
from bubblesim.controllers.differential_drive import DifferentialDrive, WheelOdometry, Wheels, wheel_speeds
from bubblesim.controllers.planar_motion import Velocity
from bubblesim.geometry.frames import into

DRIVE = DifferentialDrive(wheel_radius=0.0975, track=0.33, max_speed=12.5)
TIMEOUT = 0.6  # s without a command after which the robot stops
LIDAR = 'Pioneer_p3dx_lidar'  # also its frame


def sysCall_init():
    self.body = sim.getObject('.')
    self.motors = [sim.getObject(f'./Pioneer_p3dx_{side}Motor') for side in ('left', 'right')]
    joints = [f'Pioneer_p3dx_caster_freeJoint{i}' for i in (1, 2)]
    self.joints = self.motors + [sim.getObject(f'./{name}') for name in joints]
    self.lidar = sim.getObject(f'./{LIDAR}')
    self.last_command = None  # its time; None while the robot stands
    noise = 0.0
    if simROS:
        noise = simROS.getParamDouble('odometry_noise')[1]
        simROS.subscribe('/cmd_vel', 'geometry_msgs/Twist', on_velocity)
        self.odometry_topic = simROS.advertise('/odom', 'nav_msgs/Odometry')
        self.truth_topic = simROS.advertise('/ground_truth', 'nav_msgs/Odometry')
        self.joints_topic = simROS.advertise('/joint_states', 'sensor_msgs/JointState')
        # A mapper wants each cloud, also on a machine that sends them late.
        self.cloud_topic = simROS.advertise('/lidarPC', 'sensor_msgs/PointCloud2', 100)
    numbers = random.Random(sim.getRandom())
    self.noise = lambda: numbers.gauss(0.0, noise)
    start_odometry()


def start_odometry():
    self.odometry = WheelOdometry(DRIVE, encoders(), self.noise)


def sysCall_reset():
    start_odometry()


def on_velocity(twist):
    try:
        speeds = wheel_speeds(DRIVE, Velocity(twist['linear']['x'], twist['angular']['z']))
    except ValueError as error:
        sim.addLog(sim.verbosity_scriptwarnings, f'/cmd_vel: {error}; ignored')
        return
    self.last_command = sim.getSimulationTime()
    drive(speeds)


def drive(speeds):
    sim.setJointTargetVelocity(self.motors[0], speeds.left)
    sim.setJointTargetVelocity(self.motors[1], speeds.right)


def encoders():
    return Wheels(*map(sim.getJointPosition, self.motors))


def sysCall_actuation():
    if self.last_command is not None and sim.getSimulationTime() - self.last_command > TIMEOUT:
        self.last_command = None
        drive(Wheels(0.0, 0.0))


def sysCall_sensing():
    self.odometry.update(encoders(), sim.getSimulationTimeStep())
    if not simROS:
        return
    now = simROS.getTime()
    publish_motion(now)
    # The end of this step, if the lidar has measured in it.
    if simROS.wantsMessages(self.cloud_topic) and sim.getReadingTime(self.lidar) > sim.getSimulationTime():
        simROS.publish(self.cloud_topic, ros_messages.point_cloud(now, LIDAR, sim.readLidarPoints(self.lidar)))


def publish_motion(now):
    pose, velocity = self.odometry.pose, self.odometry.velocity
    simROS.sendTransform(ros_messages.planar_transform(now, 'odom', 'base_link', pose))
    simROS.publish(self.odometry_topic, ros_messages.planar_odometry(now, 'odom', 'base_link', pose, velocity))
    states = {sim.getObjectAlias(j): (sim.getJointPosition(j), sim.getJointVelocity(j)) for j in self.joints}
    simROS.publish(self.joints_topic, ros_messages.joint_state(now, states))
    if simROS.wantsMessages(self.truth_topic):
        simROS.publish(self.truth_topic, truth(now))


def truth(now):
    pose = sim.getObjectPose(self.body)
    linear, angular = (into(pose, velocity) for velocity in sim.getObjectVelocity(self.body))
    return ros_messages.odometry(now, 'map', 'base_link', pose=pose, linear=linear, angular=angular)
