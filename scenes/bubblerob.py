#python
# SPDX-License-Identifier: BSD-3-Clause
# BubbleRob over topics. The robot's handle is part of their names, so that several can drive in one scene:
# /leftMotorSpeed<handle> and /rightMotorSpeed<handle> [rad/s] in, /sensorTrigger<handle> and /simTime<handle> out.
# It starts rosBubbleRob, the program that drives it.


def sysCall_init():
    self.body = sim.getObject('.')
    self.left_motor = sim.getObject('./rosInterfaceControlledBubbleRobLeftMotor')
    self.right_motor = sim.getObject('./rosInterfaceControlledBubbleRobRightMotor')
    self.nose = sim.getObject('./rosInterfaceControlledBubbleRobSensingNose')
    # Copies of the robot are called ..._0, ..._1: so are their frames.
    self.frame = 'base_link' + sim.getObjectAlias(self.body).removeprefix('rosInterfaceControlledBubbleRob')
    if not simROS:
        return
    left, right, sensor, time = (
        f'{topic}{self.body}' for topic in ('leftMotorSpeed', 'rightMotorSpeed', 'sensorTrigger', 'simTime')
    )
    simROS.subscribe(f'/{left}', 'std_msgs/Float32', on_left)
    simROS.subscribe(f'/{right}', 'std_msgs/Float32', on_right)
    self.sensor_topic = simROS.advertise(f'/{sensor}', 'std_msgs/Bool')
    self.time_topic = simROS.advertise(f'/{time}', 'std_msgs/Float32')
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
    x, y, z = sim.getObjectPosition(self.body)
    qx, qy, qz, qw = sim.getObjectQuaternion(self.body)
    simROS.sendTransform({
        'header': {'stamp': simROS.getTime(), 'frame_id': 'odom'},
        'child_frame_id': self.frame,
        'transform': {'translation': {'x': x, 'y': y, 'z': z}, 'rotation': {'x': qx, 'y': qy, 'z': qz, 'w': qw}},
    })
