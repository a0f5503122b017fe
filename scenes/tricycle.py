#python
# SPDX-License-Identifier: BSD-3-Clause
# The tricycle over topics: /steering [rad] and /speed [rad/s of the front wheel] in, /front_sonar [m] and tf out.
import math


def sysCall_init():
    find_parts()
    if simROS:
        simROS.subscribe('/steering', 'std_msgs/Float32', on_steering)
        simROS.subscribe('/speed', 'std_msgs/Float32', on_speed)


def find_parts():
    self.body = sim.getObject('.')
    self.steering = sim.getObject('/Steering')
    self.motor = sim.getObject('/FrontMotor')
    self.sonar = sim.getObject('/FrontSonar')
    if simROS:
        self.sonar_topic = simROS.advertise('/front_sonar', 'std_msgs/Float32')


def on_steering(message):
    sim.setJointTargetPosition(self.steering, message['data'])


def on_speed(message):
    sim.setJointTargetVelocity(self.motor, message['data'])


def sysCall_sensing():
    if not simROS:
        return
    seen, distance, *_ = sim.readProximitySensor(self.sonar)
    # No echo is +Inf, as ROS expects of range sensors (REP 117).
    simROS.publish(self.sonar_topic, {'data': distance if seen else math.inf})
    x, y, z = sim.getObjectPosition(self.body)
    qx, qy, qz, qw = sim.getObjectQuaternion(self.body)
    simROS.sendTransform({
        'header': {'stamp': simROS.getTime(), 'frame_id': 'odom'},
        'child_frame_id': 'base_link',
        'transform': {'translation': {'x': x, 'y': y, 'z': z}, 'rotation': {'x': qx, 'y': qy, 'z': qz, 'w': qw}},
    })
