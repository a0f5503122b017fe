# SPDX-License-Identifier: BSD-3-Clause
"""The times of messages in a recorded bag are those at which they were published."""

import subprocess
from pathlib import Path

import pytest
import rosbag

from node_support import write
from ros_support import RosCore, built

SCRIPT = """
    def sysCall_init():
        self.before, self.after = (simROS.advertise(f'/{name}', 'std_msgs/Float32') for name in ('before', 'after'))
    def sysCall_actuation(): simROS.publish(self.before, {'data': simROS.getTime()})
    def sysCall_sensing(): simROS.publish(self.after, {'data': simROS.getTime()})
"""


def test_messages_have_the_time_of_the_state_in_which_they_were_published(roscore: RosCore, tmp_path: Path) -> None:
    roscore.set_param("/use_sim_time", True)
    bag, script = tmp_path / "run.bag", write(tmp_path / "script.py", SCRIPT)
    options = ["--until", "0.5", "--speed", "max", "--record", str(bag), "--child-script", f"/Ball={script}"]
    subprocess.run([str(built("sim")), "ball", *options], env=roscore.env, check=True, timeout=60)
    with rosbag.Bag(str(bag)) as file:
        for topic, first in (("/before", 0), ("/clock", 1), ("/after", 1)):
            messages = [(message, time.to_sec()) for _, message, time in file.read_messages(topics=[topic])]
            times = [0.05 * (first + n) for n in range(10)]
            assert [time for _, time in messages] == pytest.approx(times, abs=1e-6), topic
            stamps = [message.clock.to_sec() if topic == "/clock" else message.data for message, _ in messages]
            assert stamps == pytest.approx(times, abs=1e-6), topic
