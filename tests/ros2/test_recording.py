# SPDX-License-Identifier: BSD-3-Clause
"""Recordings of the ROS 2 side, read by the reader of the format's authors."""

import json
import re
import signal
import subprocess
from pathlib import Path
from typing import Any

import pytest

from node_support import Node, run_sim, write
from ros2_peer import PEERS, Domain, peer_environment
from ros_support import RosCore

SCRIPT = """
    def sysCall_init():
        self.numbers = simROS2.createPublisher('/numbers', 'std_msgs/Float32')
        self.poses = simROS2.createPublisher('/poses', 'geometry_msgs/PoseStamped')

    def sysCall_sensing():
        simROS2.publish(self.numbers, {'data': sim.getSimulationTime()})
        header = {'stamp': simROS2.getTime(), 'frame_id': 'map'}
        simROS2.publish(self.poses, {'header': header, 'pose': {'position': {'x': 1.5}, 'orientation': {'w': 1.0}}})
        print('at', f'{sim.getSimulationTime():.2f}', flush=True)
"""
READ = """
import json, sys
from mcap.reader import make_reader, NonSeekingReader
from mcap_ros2.decoder import DecoderFactory

def plain(value):
    if hasattr(value, '__slots__'):
        return {name: plain(getattr(value, name)) for name in value.__slots__}
    return value

with open(sys.argv[1], 'rb') as file:
    if sys.argv[2] == 'whole':
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        counts = reader.get_summary().statistics.channel_message_counts
    else:
        reader, counts = NonSeekingReader(file, decoder_factories=[DecoderFactory()]), {}
    found = []
    try:
        for schema, channel, message, decoded in reader.iter_decoded_messages(log_time_order=False):
            found.append([channel.topic, schema.name, message.log_time, plain(decoded)])
    except Exception as error:
        if sys.argv[2] == 'whole':
            raise
    print(json.dumps([found, sorted(counts.values())]))
"""


def read(file: Path, domain: Domain, how: str = "whole") -> tuple[list[Any], list[int]]:
    """Return topic, type, time [ns] and fields of all messages, and the numbers of messages of the channels."""
    env = peer_environment(domain)
    run = subprocess.run(
        [str(PEERS / "bin" / "python"), "-c", READ, str(file), how],
        env=env,
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    found, counts = json.loads(run.stdout)
    return found, counts


def test_messages_are_recorded_with_types_and_times(ros2_domain: Domain, tmp_path: Path) -> None:
    file, script = tmp_path / "run.mcap", write(tmp_path / "script.py", SCRIPT)
    options = ["--ros=2", "--until=0.5", "--speed=max", f"--record={file}", "--child-script", f"/Ball={script}"]
    run = run_sim("ball", *options, "_use_sim_time:=true", env=ros2_domain.env())
    assert run.returncode == 0, run.stderr
    messages, counts = read(file, ros2_domain)
    numbers = [each for each in messages if each[0] == "/numbers"]
    assert {each[1] for each in numbers} == {"std_msgs/msg/Float32"}
    assert [each[3]["data"] for each in numbers] == pytest.approx([0.05 * n for n in range(10)], abs=1e-6)
    assert [each[2] for each in numbers] == [50_000_000 * (n + 1) for n in range(10)]
    (pose, *_) = [each[3] for each in messages if each[0] == "/poses"]
    assert (pose["header"]["frame_id"], pose["pose"]["position"]["x"], pose["pose"]["orientation"]["w"]) == (
        "map",
        1.5,
        1,
    )
    clocks = [each for each in messages if each[0] == "/clock"]
    assert [each[3]["clock"]["nanosec"] for each in clocks] == [50_000_000 * (n + 1) for n in range(10)]
    assert counts == [10, 10, 10]


def test_what_was_recorded_before_a_kill_is_readable(ros2_domain: Domain, tmp_path: Path) -> None:
    file, script = tmp_path / "run.mcap", write(tmp_path / "script.py", SCRIPT)
    options = ["--ros=2", f"--record={file}", "--child-script", f"/Ball={script}", "_use_sim_time:=true"]
    with Node(ros2_domain.env(), tmp_path / "log", "ball", *options) as node:
        node.wait_for_output("at 2.50")
        node.end(signal.SIGKILL)
        last = float(re.findall(r"^at (\d+\.\d+)\n", node.output, re.MULTILINE)[-1])
    messages, _ = read(file, ros2_domain, "interrupted")
    numbers = [each[3]["data"] for each in messages if each[0] == "/numbers"]
    assert numbers == pytest.approx([0.05 * n for n in range(len(numbers))], abs=1e-5)
    assert last - 1.1 < numbers[-1] <= last + 0.06


def test_with_both_the_file_states_which_is_recorded(roscore: RosCore, ros2_domain: Domain, tmp_path: Path) -> None:
    script = write(
        tmp_path / "script.py",
        """
        def sysCall_init():
            self.one = simROS.advertise('/one', 'std_msgs/Float32')
            self.two = simROS2.createPublisher('/two', 'std_msgs/Float32')

        def sysCall_sensing():
            simROS.publish(self.one, {'data': 1.0})
            simROS2.publish(self.two, {'data': 2.0})
        """,
    )
    env = roscore.env | {"ROS_DOMAIN_ID": str(ros2_domain.number)}
    options = ["--ros=both", "--until=0.3", "--speed=max", "--child-script", f"/Ball={script}"]
    for name in ("run.mcap", "run.bag"):
        assert run_sim("ball", *options, f"--record={tmp_path / name}", env=env).returncode == 0
    messages, _ = read(tmp_path / "run.mcap", ros2_domain)
    assert {each[0] for each in messages} == {"/clock", "/two"}
    recorded = roscore.run("rosbag", "info", "--yaml", "--key=topics", str(tmp_path / "run.bag"))
    assert "/one" in recorded
    assert "/two" not in recorded
