# SPDX-License-Identifier: BSD-3-Clause
"""What a simulator that was killed has recorded can be restored, up to the last second."""

import re
import signal
from pathlib import Path

import pytest
import rosbag

from node_support import Node, write
from ros_support import RosCore

SCRIPT = """
    def sysCall_init(): self.numbers = simROS.advertise('/numbers', 'std_msgs/Float32')
    def sysCall_sensing():
        simROS.publish(self.numbers, {'data': sim.getSimulationTime()})
        print('at', f'{sim.getSimulationTime():.2f}')
"""


def test_all_but_the_last_second_of_a_killed_recording_is_restored(roscore: RosCore, tmp_path: Path) -> None:
    roscore.set_param("/use_sim_time", True)
    bag, script = tmp_path / "run.bag", write(tmp_path / "script.py", SCRIPT)
    options = ["--record", str(bag), "--child-script", f"/Ball={script}"]
    with Node(roscore.env, tmp_path / "log", "ball", *options) as node:
        node.wait_for_output("at 3.50")
        node.end(signal.SIGKILL)
        last = float(re.findall(r"^at (\d+\.\d+)\n", node.output, re.MULTILINE)[-1])
    roscore.run("rosbag", "reindex", "--quiet", str(bag))
    with rosbag.Bag(str(bag)) as file:
        numbers = [message.data for _, message, _ in file.read_messages(topics=["/numbers"])]
    assert numbers == pytest.approx([0.05 * n for n in range(len(numbers))], abs=1e-5)
    assert last - 1.1 < numbers[-1] <= last + 0.06
