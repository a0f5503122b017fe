# SPDX-License-Identifier: BSD-3-Clause
"""Measures dict <-> wire against roscpp's and rospy's serialization, side by side.

    PYTHONPATH=BUILD/benchmarks/codec /usr/bin/python3 benchmarks/codec/codec.py [--rounds N]

Configure with -DBUBBLESIM_BUILD_BENCHMARKS=ON. All candidates take turns in every round, so that a busy machine slows
them alike; the table shows the median of the rounds, in microseconds a message, and ratios of these medians.
"""

from __future__ import annotations

import argparse
import io
import statistics
import time
from collections.abc import Callable
from typing import Any

import genpy
import genpy.message
import numpy as np
import roscpp_reference

RNG = np.random.default_rng(1)


def stamped(frame: str) -> dict[str, Any]:
    """A header as scripts write it."""
    return {"seq": 1, "stamp": {"secs": 12, "nsecs": 345}, "frame_id": frame}


def vector(*values: float) -> dict[str, float]:
    """x, y, z and, for a quaternion, w."""
    return dict(zip("xyzw", values, strict=False))


def messages() -> dict[str, dict[str, Any]]:
    """One dict for each measured type, as a script would have it."""
    twist = {"linear": vector(1.0, 0.0, 0.0), "angular": vector(0.0, 0.0, 0.5)}
    pose = {"position": vector(1.0, 2.0, 0.0), "orientation": vector(0.0, 0.0, 0.0, 1.0)}
    names = [f"joint_{i}" for i in range(12)]
    fields = [{"name": name, "offset": 4 * i, "datatype": 7, "count": 1} for i, name in enumerate("xyz")]
    return {
        "std_msgs/Float32": {"data": 1.5},
        "geometry_msgs/Twist": twist,
        "nav_msgs/Odometry": {
            "header": stamped("odom"),
            "child_frame_id": "base_link",
            "pose": {"pose": pose, "covariance": RNG.random(36)},
            "twist": {"twist": twist, "covariance": RNG.random(36)},
        },
        "sensor_msgs/JointState": {
            "header": stamped(""),
            "name": names,
            "position": RNG.random(12),
            "velocity": RNG.random(12),
            "effort": RNG.random(12),
        },
        "sensor_msgs/LaserScan": {
            "header": stamped("laser"),
            "angle_min": -3.0,
            "angle_max": 3.0,
            "angle_increment": 0.01,
            "time_increment": 0.0,
            "scan_time": 0.1,
            "range_min": 0.1,
            "range_max": 30.0,
            "ranges": RNG.random(720, dtype=np.float32),
            "intensities": RNG.random(720, dtype=np.float32),
        },
        "sensor_msgs/Image": {
            "header": stamped("camera"),
            "height": 480,
            "width": 640,
            "encoding": "rgb8",
            "is_bigendian": 0,
            "step": 1920,
            "data": RNG.integers(0, 256, (480, 640, 3), dtype=np.uint8),
        },
        "sensor_msgs/PointCloud2": {
            "header": stamped("lidar"),
            "height": 1,
            "width": 100_000,
            "fields": fields,
            "is_bigendian": False,
            "point_step": 16,
            "row_step": 1_600_000,
            "data": RNG.integers(0, 256, 1_600_000, dtype=np.uint8),
            "is_dense": True,
        },
    }


def plain(value: Any) -> Any:
    """A value in the types that rospy takes: no numpy."""
    if isinstance(value, np.ndarray):
        return value.tobytes() if value.dtype == np.uint8 else value.tolist()
    return {name: plain(part) for name, part in value.items()} if isinstance(value, dict) else value


def wire_bytes(type_name: str, message: dict[str, Any]) -> bytes:
    """The message's bytes by rospy, so that our codec does not vouch for itself."""
    made = genpy.message.get_message_class(type_name)()
    genpy.message.fill_message_args(made, [plain(message)])
    return serialize(made)


def serialize(message: genpy.Message) -> bytes:
    """What rospy does to publish."""
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


def repeated(action: Callable[[], object]) -> Callable[[int], float]:
    """A timed loop over a Python call."""

    def run(count: int) -> float:
        start = time.perf_counter()
        for _ in range(count):
            action()
        return time.perf_counter() - start

    return run


def candidates(type_name: str, message: dict[str, Any]) -> dict[str, Callable[[int], float]]:
    """Everything that is measured of one type: name -> seconds for a number of conversions."""
    data = wire_bytes(type_name, message)
    message_class = genpy.message.get_message_class(type_name)
    ready = message_class().deserialize(data)
    found: dict[str, Callable[[int], float]] = {
        "encode": lambda n: roscpp_reference.encode_seconds(type_name, message, n),
        "rospy_encode": repeated(lambda: serialize(ready)),
        "decode": lambda n: roscpp_reference.decode_seconds(type_name, data, n),
        "rospy_decode": repeated(lambda: message_class().deserialize(data)),
    }
    if type_name in ("sensor_msgs/Image", "sensor_msgs/PointCloud2", "nav_msgs/Odometry"):
        found["roscpp_encode"] = lambda n: roscpp_reference.roscpp_encode_seconds(type_name, data, n)
    return found


def measure(runs: dict[str, Callable[[int], float]], rounds: int) -> dict[str, float]:
    """Median seconds of one conversion by each candidate."""
    counts = {name: max(1, int(0.002 / max(run(3) / 3, 1e-8))) for name, run in runs.items()}
    samples: dict[str, list[float]] = {name: [] for name in runs}
    for _ in range(rounds):
        for name, run in runs.items():
            run(1 + counts[name] // 10)  # what ran before has left other data in the caches
            samples[name].append(run(counts[name]) / counts[name])
    return {name: statistics.median(values) for name, values in samples.items()}


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description="Measure dict <-> wire against roscpp and rospy.")
    parser.add_argument("--rounds", type=int, default=201, help="turns that each candidate takes (default 201)")
    rounds = parser.parse_args().rounds
    print(
        f"{'us a message':26}{'encode':>9}{'roscpp':>9}{'ratio':>8}{'rospy':>9}{'ratio':>8}"
        f"{'decode':>11}{'rospy':>9}{'ratio':>8}"
    )
    for type_name, message in messages().items():
        took = {name: 1e6 * seconds for name, seconds in measure(candidates(type_name, message), rounds).items()}
        roscpp = took.get("roscpp_encode")
        versus = f"{roscpp:9.2f}{took['encode'] / roscpp:8.3f}" if roscpp else f"{'-':>9}{'-':>8}"
        print(
            f"{type_name:26}{took['encode']:9.3f}{versus}{took['rospy_encode']:9.2f}"
            f"{took['encode'] / took['rospy_encode']:8.3f}{took['decode']:11.3f}{took['rospy_decode']:9.2f}"
            f"{took['decode'] / took['rospy_decode']:8.3f}"
        )


if __name__ == "__main__":
    main()
