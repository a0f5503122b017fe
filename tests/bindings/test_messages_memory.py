# SPDX-License-Identifier: BSD-3-Clause
"""The codec does not leak, and stays safe when Python code of a value changes the message."""

import contextlib
import gc
import sys
import tracemalloc
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from message_support import codec


def growth(action: Callable[[], object]) -> int:
    """Return the bytes that stay allocated after 2000 repetitions."""
    for _ in range(100):
        action()
    gc.collect()
    tracemalloc.start()
    before, _ = tracemalloc.get_traced_memory()
    for _ in range(2000):
        action()
    gc.collect()
    after, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return after - before


def refused(action: Callable[..., object], *arguments: Any) -> Callable[[], None]:
    """Return an action that must raise MessageError."""

    def run() -> None:
        with contextlib.suppress(codec.MessageError):
            action(*arguments)
            pytest.fail("no MessageError")

    return run


ODOMETRY = codec.encode("nav_msgs/Odometry", {"header": {"frame_id": "odom"}, "child_frame_id": "base"})
JOINTS = codec.encode("sensor_msgs/JointState", {"name": ["a", "b"], "position": [1.0, 2.0]})
TRANSFORMS = codec.encode("tf2_msgs/TFMessage", {"transforms": [{}, {}]})


@pytest.mark.parametrize(
    "action",
    [
        lambda: codec.decode("nav_msgs/Odometry", ODOMETRY),
        lambda: codec.encode("nav_msgs/Odometry", codec.default("nav_msgs/Odometry")),
        lambda: codec.decode("tf2_msgs/TFMessage", TRANSFORMS, codec.TimeForm.FLOAT),
        lambda: codec.encode("sensor_msgs/JointState", {"position": np.arange(9), "name": ("x", b"y", "\udc80")}),
        lambda: codec.encode("std_msgs/UInt8MultiArray", {"data": "text"}),
        refused(codec.decode, "nav_msgs/Odometry", ODOMETRY[:-1]),
        refused(codec.decode, "sensor_msgs/JointState", JOINTS + b"x"),
        refused(codec.decode, "sensor_msgs/JointState", JOINTS[:40]),
        refused(codec.decode, "tf2_msgs/TFMessage", TRANSFORMS[:90]),
        refused(codec.encode, "std_msgs/String", {"data": "\ud800"}),
        refused(codec.encode, "tf2_msgs/TFMessage", {"transforms": ({}, {"header": {"stamp": {"secs": "x"}}})}),
        refused(codec.encode, "sensor_msgs/LaserScan", {"ranges": np.array([1e300])}),
        refused(codec.encode, "sensor_msgs/LaserScan", {"ranges": np.array(["a"])}),
        refused(codec.encode, "sensor_msgs/LaserScan", {"ranges": [1.0, object()]}),
        refused(codec.encode, "geometry_msgs/Twist", {"linear": {"w": 1}}),
    ],
)
def test_nothing_leaks(action: Callable[[], object]) -> None:
    assert min(growth(action) for _ in range(3)) < 4000  # other threads of the process allocate, too


def test_values_keep_their_reference_counts() -> None:
    values: list[Any] = [np.arange(36.0), [1.5] * 3, {"x": 1.0}, "a frame", 12345.678]
    before = [sys.getrefcount(value) for value in values]
    pose = {"position": values[2], "orientation": {}}
    message = {"header": {"frame_id": values[3]}, "pose": {"covariance": values[0], "pose": pose}}
    codec.encode("nav_msgs/Odometry", message)
    with contextlib.suppress(codec.MessageError):
        codec.encode("sensor_msgs/LaserScan", {"ranges": [values[4], "x"], "intensities": values[1]})
    del pose, message
    assert [sys.getrefcount(value) for value in values] == before


def test_dicts_and_lists_that_contain_themselves_are_refused() -> None:
    loop: dict[str, Any] = {}
    loop["linear"] = loop
    turns: list[Any] = []
    turns.append(turns)
    for name, message in [("geometry_msgs/Twist", loop), ("tf2_msgs/TFMessage", {"transforms": turns})]:
        with pytest.raises(codec.MessageError):
            codec.encode(name, message)


def test_deeply_nested_garbage_is_refused() -> None:
    deep: Any = 1.0
    for _ in range(100_000):
        deep = [deep]
    with pytest.raises(codec.MessageError):
        codec.encode("std_msgs/Float64MultiArray", {"data": deep})
    while isinstance(deep, list):  # step by step: freeing it at once also recurses deeply
        deep = deep.pop()


def test_a_list_that_empties_itself_is_refused() -> None:
    values: list[Any] = []

    class Clearing:
        def __float__(self) -> float:
            values.clear()
            return 1.0

    values.extend([Clearing(), 2.0, 3.0])
    with pytest.raises(codec.MessageError, match="shortened while it was read"):
        codec.encode("std_msgs/Float64MultiArray", {"data": values})


def test_a_dict_that_empties_itself_does_no_harm() -> None:
    message: dict[str, Any] = {}

    class Clearing:
        def __float__(self) -> float:
            message.clear()
            gc.collect()
            return 1.0

    message.update(x=Clearing(), y=2.0, z=3.0)
    assert len(codec.encode("geometry_msgs/Vector3", message)) == 24


def test_encoding_within_encoding_does_not_mix_bytes() -> None:
    class Nested:
        def __float__(self) -> float:
            codec.encode("std_msgs/String", {"data": "other bytes"})
            return 1.0

    assert codec.encode("geometry_msgs/Vector3", {"x": 1.0, "y": Nested()}) == codec.encode(
        "geometry_msgs/Vector3", {"x": 1.0, "y": 1.0}
    )
