#python
# SPDX-License-Identifier: BSD-3-Clause
# A typical subscriber and echo in a child script, for traffic.py.

QUEUE = 1000
TYPES = {
    'twist': 'geometry_msgs/Twist',
    'scan': 'sensor_msgs/LaserScan',
    'image': 'sensor_msgs/Image',
    'cloud': 'sensor_msgs/PointCloud2',
}


def sysCall_init():
    self.counts = {}
    for name, kind in TYPES.items():
        self.counts[name] = 0
        simROS.subscribe(name, kind, counter(name), QUEUE)
    self.pong = simROS.advertise('pong', 'geometry_msgs/Twist', QUEUE)
    simROS.subscribe('ping', 'geometry_msgs/Twist', 'echo', QUEUE)


def counter(name):
    def count(message):
        self.counts[name] += 1

    return count


def echo(message):
    simROS.publish(self.pong, message)


def sysCall_cleanup():
    for name, count in self.counts.items():
        print(name, count)
