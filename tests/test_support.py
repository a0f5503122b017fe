# SPDX-License-Identifier: BSD-3-Clause
"""The helpers of the tests, where a mistake would show up as a failure of another test."""

from ros_support import RosCore


def test_a_roscore_that_has_learnt_a_type_is_not_given_to_the_next_test(roscore: RosCore) -> None:
    assert roscore.is_as_new()
    roscore.run("rostopic", "pub", "-1", "/t", "std_msgs/UInt8", "data: 1")
    assert roscore.nodes() == {"/rosout"}
    assert not roscore.is_as_new()
