# SPDX-License-Identifier: BSD-3-Clause
"""Measures what peers of ROS 2 that come and go cost the steps of a simulation.

A node with the scene tricycle and 20 silent publishers makes a step every 2 ms. A node of rclpy that subscribes to them
starts and ends, alternately in the domain of the simulation and in another one, with the same load of the machine.
Prints the 99th percentile of the time from a step's actuation to its sensing: medians over the rounds, and of the
ratios in each round.

Needs a build with ROS 2 and the tests' environment with rclpy (scripts/setup --with ros2 --with tests):

    source scripts/environment/activate.bash && python3 benchmarks/ros2/joining.py [--rounds N]
"""

from __future__ import annotations

import argparse
import os
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
PEERS = ROOT / ".ws" / "ros2_peers" / "bin" / "python"
OWN, OTHER = "85", "86"

SCRIPT = """
import time
import numpy as np

def sysCall_init():
    self.times = []
    self.topics = [simROS2.createPublisher(f'/topic{{n}}', 'std_msgs/Float32') for n in range(20)]

def sysCall_actuation():
    self.begin = time.monotonic()

def sysCall_sensing():
    now = time.monotonic()
    self.times.append((now, now - self.begin))

def sysCall_cleanup():
    np.save('{file}', np.array(self.times))
"""

PEER = """
import time
import rclpy
from rclpy.node import Node
from std_msgs.msg import Float32

rclpy.init()
node = Node('peer')
for n in range(20):
    node.create_subscription(Float32, f'/topic{n}', lambda message: None, 10)
end = time.monotonic() + 2.0
while time.monotonic() < end:
    rclpy.spin_once(node, timeout_sec=0.1)
node.destroy_node()
rclpy.shutdown()
"""


def life(domain: str, env: dict[str, str]) -> tuple[float, float]:
    """Let a peer join and leave a domain; return when that was."""
    begin = time.monotonic()
    subprocess.run([PEERS, "-c", PEER], env={**env, "ROS_DOMAIN_ID": domain}, check=True)
    return begin, time.monotonic() + 0.5


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description="Measures what peers of ROS 2 that come and go cost the steps.")
    parser.add_argument("--rounds", type=int, default=20, help="number of rounds (default 20)")
    rounds = parser.parse_args().rounds
    env = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "LD_", "VIRTUAL"))}
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "times.npy")
        script = Path(folder, "script.py")
        script.write_text(SCRIPT.format(file=file))
        command = [
            "rosrun",
            "bubblesim",
            "sim",
            "tricycle",
            "--ros=2",
            "--speed=25",
            f"--child-script=/Tricycle={script}",
        ]
        with subprocess.Popen(command, env={**os.environ, "ROS_DOMAIN_ID": OWN}) as node:
            time.sleep(3.0)
            lives = [tuple(life(domain, env) for domain in (OTHER, OWN)) for _ in range(rounds)]
            node.send_signal(signal.SIGINT)
        times = np.load(file)
    found = [
        [1e6 * np.percentile(times[(times[:, 0] > begin) & (times[:, 0] < end), 1], 99) for begin, end in pair]
        for pair in lives
    ]
    elsewhere, here = (statistics.median(column) for column in zip(*found, strict=True))
    ratio = statistics.median(after / before for before, after in found)
    print(f"99th percentile, us: a peer in another domain {elsewhere:.1f}, in this one {here:.1f}, ratio {ratio:.2f}")


if __name__ == "__main__":
    sys.exit(main())
