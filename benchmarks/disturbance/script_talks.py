#python
# SPDX-License-Identifier: BSD-3-Clause
# Publishes and subscribes like an ordinary script, and publishes an image of one megabyte.


def sysCall_init():
    self.image = {'height': 500, 'width': 667, 'encoding': 'rgb8', 'step': 2001, 'data': bytes(2001 * 500)}
    self.big = simROS.advertise('/big', 'sensor_msgs/Image', 10)
    self.odometry = simROS.advertise('odometry', 'nav_msgs/Odometry', 10)
    simROS.subscribe('odometry', 'nav_msgs/Odometry', 'on_odometry', 10)


def on_odometry(message):
    self.received = message['header']['stamp']


def sysCall_sensing():
    x, y, z = sim.getObjectPosition(sim.getObject('.'))
    position = {'x': x, 'y': y, 'z': z}
    simROS.publish(self.odometry, {'header': {'stamp': simROS.getTime()}, 'pose': {'pose': {'position': position}}})
    simROS.publish(self.big, self.image)
