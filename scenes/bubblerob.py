#python
# SPDX-License-Identifier: BSD-3-Clause
# ROS interface of BubbleRob. The topic names contain the robot's handle, so that several robots can drive in one scene.
# Subscribes to /leftMotorSpeed<handle> and /rightMotorSpeed<handle> [rad/s]; publishes /sensorTrigger<handle> and
# /simTime<handle>. Starts rosBubbleRob, the program that controls the robot.
from bubblesim import ros_messages


def sysCall_init():
    self.body = sim.getObject('.')
    self.left_motor = sim.getObject('./rosInterfaceControlledBubbleRobLeftMotor')
    self.right_motor = sim.getObject('./rosInterfaceControlledBubbleRobRightMotor')
    self.nose = sim.getObject('./rosInterfaceControlledBubbleRobSensingNose')
    # Copies of the robot are named ..._0, ..._1; their frames have the same suffix.
    self.frame = 'base_link' + sim.getObjectAlias(self.body).removeprefix('rosInterfaceControlledBubbleRob')
    self.joints_topic = None
    if not simROS:
        return
    left, right, sensor, time = (
        f'{topic}{self.body}' for topic in ('leftMotorSpeed', 'rightMotorSpeed', 'sensorTrigger', 'simTime')
    )
    simROS.subscribe(f'/{left}', 'std_msgs/Float32', on_left)
    simROS.subscribe(f'/{right}', 'std_msgs/Float32', on_right)
    self.sensor_topic = simROS.advertise(f'/{sensor}', 'std_msgs/Bool')
    self.time_topic = simROS.advertise(f'/{time}', 'std_msgs/Float32')
    if self.frame == 'base_link':  # robot_state_publisher handles one robot only
        self.joints_topic = simROS.advertise('/joint_states', 'sensor_msgs/JointState')
    self.notifications = simROS.advertise('/notifications', 'test_msgs/Notification')
    sim.launchExecutable('rosBubbleRob', f'{left} {right} {sensor} {time}')


def on_left(message):
    sim.setJointTargetVelocity(self.left_motor, message['data'])


def on_right(message):
    sim.setJointTargetVelocity(self.right_motor, message['data'])


def sysCall_sensing():
    if not simROS:
        return
    seen, *_ = sim.readProximitySensor(self.nose)
    simROS.publish(self.sensor_topic, {'data': seen > 0})
    simROS.publish(self.time_topic, {'data': sim.getSimulationTime()})
    simROS.publish(self.notifications, {'messages': 'ok'})
    now = simROS.getTime()
    simROS.sendTransform(ros_messages.transform(now, 'odom', self.frame, sim.getObjectPose(self.body)))
    if self.joints_topic is not None and simROS.wantsMessages(self.joints_topic):
        motors = (self.left_motor, self.right_motor)
        states = {sim.getObjectAlias(j): (sim.getJointPosition(j), sim.getJointVelocity(j)) for j in motors}
        simROS.publish(self.joints_topic, ros_messages.joint_state(now, states))
