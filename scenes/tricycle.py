#python
# SPDX-License-Identifier: BSD-3-Clause
# ROS interface of the tricycle. Subscribes to /steering [rad] and /speed [rad/s of the front wheel]; publishes
# /front_sonar [m], /odom and its transform, /joint_states, /image with /camera_info, and /fix. Sensors measure only
# while their topics have subscribers.
import math

from bubblesim import ros_messages
from bubblesim.controllers.planar_motion import Pose2D, moved
from bubblesim.controllers.tricycle_drive import FrontWheel, Tricycle, velocity

CAMERA_FRAME = 'Camera_optical'
MEASURES = Tricycle(wheelbase=1.0, wheel_radius=0.3)


def sysCall_init():
    find_parts()
    if simROS:
        simROS.subscribe('/steering', 'std_msgs/Float32', on_steering)
        simROS.subscribe('/speed', 'std_msgs/Float32', on_speed)


def find_parts():
    self.body = sim.getObject('.')
    self.steering = sim.getObject('/Steering')
    self.motor = sim.getObject('/FrontMotor')
    self.joints = [self.steering, self.motor, sim.getObject('/RearLeftAxle'), sim.getObject('/RearRightAxle')]
    self.sonar = sim.getObject('/FrontSonar')
    self.camera = sim.getObject('/Camera')
    self.gps = sim.getObject('/Gps')
    start_odometry()
    if simROS:
        self.sonar_topic = simROS.advertise('/front_sonar', 'std_msgs/Float32')
        self.odometry_topic = simROS.advertise('/odom', 'nav_msgs/Odometry')
        self.joints_topic = simROS.advertise('/joint_states', 'sensor_msgs/JointState')
        self.image_topic = simROS.imageTransportAdvertise('/image')
        self.camera_topic = simROS.advertise('/camera_info', 'sensor_msgs/CameraInfo')
        self.fix_topic = simROS.advertise('/fix', 'sensor_msgs/NavSatFix')


def start_odometry():
    # The odometry starts at the robot's pose: its frame is then that of the world.
    x, y, _ = sim.getObjectPosition(self.body)
    self.pose = Pose2D(x, y, sim.getObjectOrientation(self.body)[2])
    self.wheel_angle = sim.getJointPosition(self.motor)
    self.steered = sim.getJointPosition(self.steering)


def sysCall_reset():
    start_odometry()


def on_steering(message):
    sim.setJointTargetPosition(self.steering, message['data'])


def on_speed(message):
    sim.setJointTargetVelocity(self.motor, message['data'])


def sysCall_sensing():
    if not simROS:
        return
    now = simROS.getTime()
    seen, distance, *_ = sim.readProximitySensor(self.sonar)
    # +Inf without an echo (REP 117).
    simROS.publish(self.sonar_topic, {'data': distance if seen else math.inf})
    publish_motion(now)
    publish_picture(now)
    publish_fix(now)


def move_odometry():
    """Compute the velocity from encoder and angle of the front wheel, and integrate the pose."""
    angle, dt = sim.getJointPosition(self.motor), sim.getSimulationTimeStep()
    wheel_speed = math.remainder(angle - self.wheel_angle, math.tau) / dt
    steered = sim.getJointPosition(self.steering)
    speed = velocity(MEASURES, FrontWheel((self.steered + steered) / 2, wheel_speed))
    self.wheel_angle, self.steered = angle, steered
    self.pose = moved(self.pose, speed, dt)
    return speed


def publish_motion(now):
    speed = move_odometry()
    simROS.sendTransform(ros_messages.planar_transform(now, 'odom', 'base_link', self.pose))
    if simROS.wantsMessages(self.odometry_topic):
        odometry = ros_messages.planar_odometry(now, 'odom', 'base_link', self.pose, speed)
        simROS.publish(self.odometry_topic, odometry)
    if simROS.wantsMessages(self.joints_topic):
        states = {sim.getObjectAlias(j): (sim.getJointPosition(j), sim.getJointVelocity(j)) for j in self.joints}
        simROS.publish(self.joints_topic, ros_messages.joint_state(now, states))


def publish_picture(now):
    picture_is_wanted = simROS.wantsMessages(self.image_topic)
    if not picture_is_wanted and not simROS.wantsMessages(self.camera_topic):
        return
    if not is_new(self.camera):
        return
    width, height = sim.getVisionSensorRes(self.camera)
    if picture_is_wanted:  # rendering takes most of the time
        picture = sim.getVisionSensorArray(self.camera)
        simROS.imageTransportPublish(self.image_topic, picture[::-1], width, height, CAMERA_FRAME)
    field_of_view = sim.getVisionSensorFieldOfView(self.camera)
    info = ros_messages.camera_info(now, CAMERA_FRAME, width, height, field_of_view, simROS.rosVersion())
    simROS.publish(self.camera_topic, info)


def publish_fix(now):
    if simROS.wantsMessages(self.fix_topic) and is_new(self.gps):
        (latitude, longitude, altitude), _ = sim.readNavSat(self.gps)
        fix = ros_messages.nav_sat_fix(now, 'Gps', latitude, longitude, altitude, variances=[4e-4, 4e-4, 1.6e-3])
        simROS.publish(self.fix_topic, fix)


def is_new(sensor):
    """Whether the sensor was due in this step: its measurement shows the end of the step."""
    return sim.getReadingTime(sensor) > sim.getSimulationTime()
