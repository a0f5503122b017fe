# SPDX-License-Identifier: BSD-3-Clause
"""Transforms of child scripts, with tf2's listener."""

import subprocess
from collections.abc import Callable

import pytest

from node_support import Node, without_slowness
from ros_support import DEADLINE, RosCore, wait_until

Script = Callable[[str], Node]

LOOK_UP = """
import rospy, tf2_ros
rospy.init_node('observer')
buffer = tf2_ros.Buffer()
listener = tf2_ros.TransformListener(buffer)
for target in ('moving', 'first', 'second', 'late'):
    found = buffer.lookup_transform('world', target, rospy.Time(0), rospy.Duration(20))
    print(target, found.transform.translation.x)
"""


def test_tf2_looks_up_dynamic_and_static_transforms(script: Script, roscore: RosCore) -> None:
    node = script("""\
        def transform(child, x):
            return {'header': {'frame_id': 'world', 'stamp': simROS.getTime()}, 'child_frame_id': child,
                    'transform': {'translation': {'x': x}, 'rotation': {'w': 1}}}
        def sysCall_init():
            simROS.sendStaticTransforms([transform('first', 9), transform('second', 2)])
            simROS.sendStaticTransform(transform('first', 1))
            simROS2.sendStaticTransform(transform('late', 3))
        def sysCall_sensing():
            simROS.sendTransform(transform('moving', 0.5))
        """)
    wait_until(lambda: "/tf_static" in roscore.state()["publishers"], "the static transforms")
    wait_until(lambda: "/tf" in roscore.state()["publishers"], "the transforms")
    look_up = ["/usr/bin/python3", "-c", LOOK_UP]
    seen = subprocess.run(look_up, env=roscore.env, capture_output=True, text=True, timeout=4 * DEADLINE, check=False)
    assert seen.stdout == "moving 0.5\nfirst 1.0\nsecond 2.0\nlate 3.0\n", seen.stderr
    assert "warning" not in without_slowness(node.output)


@pytest.mark.parametrize(
    ("transform", "reported"),
    [
        ("{'rotation': {'w': 2}}", "is not a unit quaternion (x, y, z, w), its norm is 2; the identity is 0, 0, 0, 1"),
        ("{}", "its norm is 0"),
        ("{'translation': {'y': float('nan')}, 'rotation': {'w': 1}}", "translation [0.0, nan, 0.0] is not finite"),
    ],
)
def test_a_transform_that_tf2_would_refuse_is_reported_with_its_frame(
    script: Script, transform: str, reported: str
) -> None:
    node = script(f"""\
        def sysCall_init():
            for send in (simROS.sendTransform, simROS.sendStaticTransform):
                try:
                    send({{'header': {{'frame_id': 'a'}}, 'child_frame_id': 'b', 'transform': {transform}}})
                except ValueError as error:
                    print('reported:', error)
            print('done')
        """)
    node.wait_for_output("done")
    assert node.output.count("reported: the transform of 'b'") == 2
    assert node.output.count(reported) == 2


def test_a_transform_of_wrong_fields_is_reported_as_any_message(script: Script) -> None:
    node = script("def sysCall_init(): simROS.sendTransform({'transform': {'rotaton': {}, 'rotation': {'w': 1}}})\n")
    node.wait_for_output("MessageError")
    assert "rotaton" in node.output


@pytest.mark.parametrize(("module", "stamp"), [("simROS", "5.0"), ("simROS2", "{'sec': 5, 'nanosec': 0}")])
def test_stamps_of_another_clock_are_reported_once_a_publisher(script: Script, module: str, stamp: str) -> None:
    make = "simROS.advertise" if module == "simROS" else "simROS2.createPublisher"
    node = script(f"""\
        def sysCall_init():
            self.odometry = {make}('/odom', 'nav_msgs/Odometry')
        def sysCall_sensing():
            header = {{'stamp': {stamp}, 'frame_id': 'odom'}}
            {module}.publish(self.odometry, {{'header': header}})
            {module}.sendTransform({{'header': header, 'transform': {{'rotation': {{'w': 1}}}}}})
            if sim.getSimulationTime() > 0.2:
                print('done')
        """)
    node.wait_for_output("done")
    warnings = [line for line in without_slowness(node.output).splitlines() if line.startswith("warning")]
    assert [line.split("'")[1] for line in warnings] == ["/odom", "/tf"]
    for line in warnings:
        assert "before ROS time" in line
        assert line.endswith(f"stamp with {module}.getTime()")
