# SPDX-License-Identifier: BSD-3-Clause
"""Compare the conversion dict <-> serialized message with roscpp's and rospy's serialization.

    PYTHONPATH=BUILD/benchmarks/codec /usr/bin/python3 benchmarks/codec/codec.py [--rounds N] [--processes N]

Configure with -DBUBBLESIM_BUILD_BENCHMARKS=ON. The candidates run alternately in every round, so that other load
affects them equally. The address of large buffers changes the copying time by a few percent for the lifetime of a
process, so several processes measure. The table shows medians over the processes of the medians over their rounds, in
microseconds per message, and medians of the ratios in each process.
"""

from __future__ import annotations

import argparse
import io
import multiprocessing
import statistics
import time
from collections.abc import Callable
from typing import Any

import genpy
import genpy.message
import numpy as np
import roscpp_reference
import rospy.msg

RNG = np.random.default_rng(1)


def stamped(frame: str) -> dict[str, Any]:
    """Return a header in the format of scripts."""
    return {"seq": 1, "stamp": {"secs": 12, "nsecs": 345}, "frame_id": frame}


def vector(x: float, y: float, z: float) -> dict[str, float]:
    """Return a vector in the format of scripts."""
    return {"x": x, "y": y, "z": z}


def messages() -> dict[str, dict[str, Any]]:
    """Return one dict for each measured type, in the format of scripts."""
    twist = {"linear": vector(1.0, 0.0, 0.0), "angular": vector(0.0, 0.0, 0.5)}
    pose = {"position": vector(1.0, 2.0, 0.0), "orientation": {**vector(0.0, 0.0, 0.0), "w": 1.0}}
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
    """Convert numpy arrays to types that rospy accepts."""
    if isinstance(value, np.ndarray):
        return value.tobytes() if value.dtype == np.uint8 else value.tolist()
    return {name: plain(part) for name, part in value.items()} if isinstance(value, dict) else value


def wire_bytes(type_name: str, message: dict[str, Any]) -> bytes:
    """Serialize the message with genpy, independently of the measured codec."""
    made = genpy.message.get_message_class(type_name)()
    genpy.message.fill_message_args(made, [plain(message)])
    buffer = io.BytesIO()
    made.serialize(buffer)
    return buffer.getvalue()


class Publisher:
    """The work of a rospy publisher between `publish` and its sockets (rospy/topics.py)."""

    def __init__(self) -> None:
        """Create the buffer that all messages share."""
        self.buffer = io.BytesIO()

    def serialize(self, message: genpy.Message) -> bytes:
        """Serialize a message as it is sent."""
        rospy.msg.serialize_message(self.buffer, 1, message)
        data = self.buffer.getvalue()
        self.buffer.seek(0)
        self.buffer.truncate(0)
        return data


def repeated(action: Callable[[], object]) -> Callable[[int], float]:
    """Return a timed loop over a Python call."""

    def run(count: int) -> float:
        start = time.perf_counter()
        for _ in range(count):
            action()
        return time.perf_counter() - start

    return run


def candidates(type_name: str, message: dict[str, Any]) -> dict[str, Callable[[int], float]]:
    """Return all measurements of one type: name -> function from number of conversions to seconds."""
    data = wire_bytes(type_name, message)
    message_class = genpy.message.get_message_class(type_name)
    ready = message_class().deserialize(data)
    publisher = Publisher()
    found: dict[str, Callable[[int], float]] = {
        "encode": lambda n: roscpp_reference.encode_seconds(type_name, message, n),
        "rospy_encode": repeated(lambda: publisher.serialize(ready)),
        "decode": lambda n: roscpp_reference.decode_seconds(type_name, data, n),
        "rospy_decode": repeated(lambda: message_class().deserialize(data)),
    }
    if type_name in ("sensor_msgs/Image", "sensor_msgs/PointCloud2", "nav_msgs/Odometry"):
        found["roscpp_encode"] = lambda n: roscpp_reference.roscpp_encode_seconds(type_name, data, n)
    return found


def measure(type_name: str, rounds: int) -> dict[str, float]:
    """Return the median time of one conversion in microseconds for each candidate, in this process."""
    runs = candidates(type_name, messages()[type_name])
    counts = {name: max(1, int(0.002 / max(run(3) / 3, 1e-8))) for name, run in runs.items()}
    samples: dict[str, list[float]] = {name: [] for name in runs}
    for _ in range(rounds):
        for name, run in runs.items():
            run(1 + counts[name] // 10)  # warms up the caches
            samples[name].append(1e6 * run(counts[name]) / counts[name])
    return {name: statistics.median(values) for name, values in samples.items()}


def measure_in_processes(type_name: str, rounds: int, processes: int) -> list[dict[str, float]]:
    """Run measure() in new processes, one after the other."""
    with multiprocessing.get_context("spawn").Pool(1, maxtasksperchild=1) as pool:
        return pool.starmap(measure, [(type_name, rounds)] * processes, chunksize=1)


def row(type_name: str, measured: list[dict[str, float]]) -> str:
    """Return a line of the table."""

    def column(ours: str, peer: str) -> str:
        if peer not in measured[0]:
            return f"{'-':>9}{'-':>8}"
        ratio = statistics.median(took[ours] / took[peer] for took in measured)
        return f"{statistics.median(took[peer] for took in measured):9.2f}{ratio:8.3f}"

    encode, decode = (statistics.median(took[ours] for took in measured) for ours in ("encode", "decode"))
    return (
        f"{type_name:26}{encode:9.3f}{column('encode', 'roscpp_encode')}{column('encode', 'rospy_encode')}"
        f"{decode:11.3f}{column('decode', 'rospy_decode')}"
    )


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description="Compare the serialization of dicts with roscpp and rospy.")
    parser.add_argument("--rounds", type=int, default=41, help="rounds per process (default 41)")
    parser.add_argument("--processes", type=int, default=9, help="processes per type (default 9)")
    options = parser.parse_args()
    print(
        f"{'us per message':26}{'encode':>9}{'roscpp':>9}{'ratio':>8}{'rospy':>9}{'ratio':>8}"
        f"{'decode':>11}{'rospy':>9}{'ratio':>8}"
    )
    for type_name in messages():
        print(row(type_name, measure_in_processes(type_name, options.rounds, options.processes)), flush=True)


if __name__ == "__main__":
    main()
