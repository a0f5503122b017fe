# SPDX-License-Identifier: BSD-3-Clause
"""Times the publishing of messages by a script, on ROS 1 and on ROS 2, by rclpy, and by Fast DDS alone.

Each has one subscriber. In each step, the script publishes in one of three ways, in turn: roscpp sends after the call,
in a thread of its own. Fast DDS gets ready bytes, in the process of the node, where the caches are as cold as they are
for the node. rclpy is timed after the script. A second table compares the encoders of both sides, without a publisher.

Needs a build with ROS 2 and the tests' environment with rclpy (scripts/setup --with ros2 --with tests):

    source scripts/environment/activate.bash && cmake --build .ws/build/bubblesim --target fast_dds_alone
    PYTHONPATH=.ws/build/bubblesim/benchmarks/ros2:$PYTHONPATH python3 benchmarks/ros2/publish.py
"""

from __future__ import annotations

import contextlib
import json
import os
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from bubblesim import _core

ROOT = Path(__file__).resolve().parents[2]
PEERS = ROOT / ".ws" / "ros2_peers" / "bin" / "python"
DOMAIN = "87"
ROUNDS = 300

# By type: the message, as code that both sides understand; `np` is numpy.
MESSAGES = {
    "std_msgs/Float32": "{'data': 1.5}",
    "geometry_msgs/Twist": "{'linear': {'x': 1.0}, 'angular': {'z': 0.5}}",
    "sensor_msgs/LaserScan": "{'range_max': 10.0, 'ranges': np.ones(720, np.float32)}",
    "sensor_msgs/Image": "{'width': 640, 'height': 480, 'step': 1920, 'encoding': 'rgb8', "
    "'data': np.zeros(1920 * 480, np.uint8)}",
    "sensor_msgs/PointCloud2": "{'height': 1, 'width': 100000, 'point_step': 12, 'row_step': 1200000, "
    "'data': np.zeros(1200000, np.uint8)}",
}

SCRIPT = """
import json
import time
import fast_dds_alone
import numpy as np
from bubblesim import _core

MESSAGES = {messages}

def ready(kind):
    cdr = _core.messages.encode_ros2(kind, MESSAGES[kind])
    return fast_dds_alone.Publisher('/dds/' + kind.split('/')[1], kind, cdr)

def sysCall_init():
    self.times = {{}}
    self.one = {{kind: simROS.advertise('/one/' + kind.split('/')[1], kind, 10) for kind in MESSAGES}}
    self.two = {{kind: simROS2.createPublisher('/two/' + kind.split('/')[1], kind, 10) for kind in MESSAGES}}
    self.alone = {{kind: ready(kind) for kind in MESSAGES}}
    self.step = 0

def all_have_subscribers():
    return (all(map(simROS.wantsMessages, self.one.values())) and all(map(simROS2.wantsMessages, self.two.values()))
            and all(each.has_subscriber() for each in self.alone.values()))

def time_of(way, kind, message):
    if way == 'Fast DDS':
        return self.alone[kind].write()
    module, publisher = (simROS, self.one[kind]) if way == 'ROS 1' else (simROS2, self.two[kind])
    begin = time.perf_counter()
    module.publish(publisher, message)
    return time.perf_counter() - begin

def sysCall_sensing():
    if not all_have_subscribers():
        return
    self.step += 1
    way = ('ROS 1', 'ROS 2', 'Fast DDS')[self.step % 3]
    for kind, message in MESSAGES.items():
        self.times.setdefault(way + ' ' + kind, []).append(time_of(way, kind, message))
    if self.step == {rounds} * 3:
        medians = {{name: 1e6 * float(np.median(each)) for name, each in self.times.items()}}
        print('times', json.dumps(medians), flush=True)
        sim.stopSimulation()
"""

RCLPY = """
import contextlib, importlib, json, sys, time
import numpy as np
import rclpy
from rclpy.node import Node

MESSAGES = {messages}

def type_of(name):
    package, short = name.split('/')
    return getattr(importlib.import_module(package + '.msg'), short)

def fill(message, values):
    for name, value in values.items():
        if isinstance(value, dict):
            fill(getattr(message, name), value)
        else:
            setattr(message, name, value.tobytes() if getattr(value, 'dtype', None) == np.uint8 else value)
    return message

rclpy.init()
node = Node('benchmark_' + sys.argv[1])
if sys.argv[1] == 'subscriber':
    for kind in MESSAGES:
        for side in ('two', 'rclpy', 'dds'):
            node.create_subscription(type_of(kind), '/' + side + '/' + kind.split('/')[1], lambda message: None, 10)
    with contextlib.suppress(rclpy.executors.ExternalShutdownException):
        rclpy.spin(node)
    sys.exit()
publishers = {{kind: node.create_publisher(type_of(kind), '/rclpy/' + kind.split('/')[1], 10) for kind in MESSAGES}}
while not all(each.get_subscription_count() for each in publishers.values()):
    time.sleep(0.05)
times = {{kind: [] for kind in MESSAGES}}
for _ in range({rounds}):
    for kind, values in MESSAGES.items():
        begin = time.perf_counter()
        publishers[kind].publish(fill(type_of(kind)(), values))
        times[kind].append(time.perf_counter() - begin)
    time.sleep(0.02)
print(json.dumps({{kind: 1e6 * float(np.median(each)) for kind, each in times.items()}}), flush=True)
"""

ROSPY = """
import importlib
import rospy

rospy.init_node('benchmark_subscriber')
for kind in {kinds}:
    package, short = kind.split('/')
    rospy.Subscriber('/one/' + short, getattr(importlib.import_module(package + '.msg'), short), lambda message: None)
rospy.spin()
"""


def code(template: str, **more: object) -> str:
    """Return a program with the messages in it."""
    messages = "{" + ", ".join(f"{kind!r}: {text}" for kind, text in MESSAGES.items()) + "}"
    return template.format(messages=messages, rounds=ROUNDS, **more)


def encoding_time(encode: Callable[[str, object], bytes], kind: str, message: object) -> float:
    """Return the microseconds of a call."""
    calls = 2000 if len(encode(kind, message)) < 10000 else 50
    begin = time.perf_counter()
    for _ in range(calls):
        encode(kind, message)
    return 1e6 * (time.perf_counter() - begin) / calls


def print_encoders() -> None:
    """Print a table of medians of the encoders, which run alternately."""
    print(f"{'dict to bytes, us':24}{'ROS 1':>10}{'ROS 2':>10}{'ratio':>30}")
    for kind, text in MESSAGES.items():
        message = eval(text, {"np": np})
        sides = (_core.messages.encode, _core.messages.encode_ros2)
        times = [[encoding_time(encode, kind, message) for encode in sides] for _ in range(21)]
        one, two = np.median(times, axis=0)
        print(f"{kind:24}{one:10.2f}{two:10.2f}{two / one:30.2f}")


def main() -> None:
    """Print a table of medians."""
    env = {**os.environ, "ROS_DOMAIN_ID": DOMAIN, "ROS_HOSTNAME": "localhost"}
    env["ROS_MASTER_URI"] = "http://localhost:11987"
    alone = {name: value for name, value in env.items() if not name.startswith(("PYTHON", "LD_", "VIRTUAL"))}
    with tempfile.TemporaryDirectory() as folder, contextlib.ExitStack() as stack:

        def start(*command: str, env: dict[str, str]) -> subprocess.Popen[str]:
            process = subprocess.Popen(command, env=env, stdout=subprocess.PIPE, text=True)
            stack.callback(process.wait)
            stack.callback(process.terminate)
            return process

        script = Path(folder, "script.py")
        script.write_text(code(SCRIPT))
        rclpy = Path(folder, "rclpy_peer.py")
        rclpy.write_text(code(RCLPY))
        start("roscore", "-p", "11987", env=env)
        time.sleep(3.0)
        start("/usr/bin/python3", "-c", ROSPY.format(kinds=list(MESSAGES)), env=env)
        start(str(PEERS), str(rclpy), "subscriber", env=alone)
        node = start("rosrun", "bubblesim", "sim", "ball", "--ros=both", f"--child-script=/Ball={script}", env=env)
        assert node.stdout is not None
        ours = next(json.loads(found[1]) for line in node.stdout if (found := re.search(r"times (\{.*\})", line)))
        rclpys = json.loads(start(str(PEERS), str(rclpy), "publisher", env=alone).communicate()[0])
    print(f"{'median, us':24}{'ROS 1':>10}{'ROS 2':>10}{'rclpy':>10}{'Fast DDS':>10}{'ratio':>8}")
    for kind in MESSAGES:
        one, two, dds = (ours[f"{way} {kind}"] for way in ("ROS 1", "ROS 2", "Fast DDS"))
        print(f"{kind:24}{one:10.1f}{two:10.1f}{rclpys[kind]:10.1f}{dds:10.1f}{two / dds:8.2f}")
    print_encoders()


if __name__ == "__main__":
    sys.exit(main())
