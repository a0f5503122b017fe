#python
# SPDX-License-Identifier: BSD-3-Clause
# Measures the cost of publishing a Twist without subscribers in a child script, for traffic.py.
import statistics
import time
import timeit

ROUNDS = 41
CALLS = 20_000
TWIST = {'linear': {'x': 1.0, 'y': 0.0, 'z': 0.0}, 'angular': {'x': 0.0, 'y': 0.0, 'z': 0.5}}


def sysCall_init():
    publisher = simROS.advertise('unheard', 'geometry_msgs/Twist')
    timer = timeit.Timer(lambda: simROS.publish(publisher, TWIST), timer=time.thread_time)
    print(statistics.median(timer.repeat(ROUNDS, CALLS)) / CALLS * 1e6)
