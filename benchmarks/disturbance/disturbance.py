# SPDX-License-Identifier: BSD-3-Clause
"""Measure the effect of network problems on the times of simulation steps.

    PYTHONPATH=tests python benchmarks/disturbance/disturbance.py BUILD/devel/lib/bubblesim [--rounds N]

Source the workspace first; the program starts its own masters. The two cases of a comparison run alternately, with the
same load of the machine:

- master: the 99th percentile of the step times (one step every 2 ms) while the node's own master is killed and started
  again, compared with that while another master is restarted
- stopped subscriber: the median at 50 steps per second that send one megabyte each, with one running and one stopped
  subscriber, compared with that with the running subscriber only

Prints medians over the rounds, and of the ratios in each round.
"""

from __future__ import annotations

import argparse
import signal
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

from ros_support import RestartableCore, RosCore, start, stop

HERE = Path(__file__).parent
SETTLED = 2.0  # s until a new master has all registrations, and a new subscriber is connected
FAST = 2  # ms per simulation step
AT_50_HZ = 20
LOADED = 8.0  # s of sending


class Simulator:
    """A simulation that measures its step times."""

    def __init__(self, built: Path, core: RosCore, period: int) -> None:
        """Start the simulation; ``period`` is in milliseconds."""
        command = [str(built / "step_times"), str(HERE / "script_talks.py"), str(period)]
        self._process = start(command, core.env, stdin=subprocess.PIPE, stdout=subprocess.PIPE)

    def times(self) -> tuple[float, float]:
        """Return median and 99th percentile of the step times since the last call, in microseconds."""
        assert self._process.stdin
        assert self._process.stdout
        print(file=self._process.stdin, flush=True)
        median, percentile = map(float, self._process.stdout.readline().split())
        return median, percentile

    def end(self) -> None:
        """End the simulation."""
        stop(self._process)


def restart(core: RestartableCore) -> None:
    """Kill a master and start it again."""
    core.kill()
    core.start()
    time.sleep(SETTLED)


def master_rounds(built: Path, folder: Path, rounds: int) -> list[tuple[float, float]]:
    """Return 99th percentiles while another master is restarted, and while the own master is restarted."""
    own, other = RestartableCore(folder), RestartableCore(folder)
    simulator = Simulator(built, own.core, FAST)
    time.sleep(SETTLED)
    found = []
    for _ in range(rounds):
        percentiles = []
        for core in (other, own):
            simulator.times()
            restart(core)
            percentiles.append(simulator.times()[1])
        found.append((percentiles[0], percentiles[1]))
    simulator.end()
    stop(own.core.process)
    stop(other.core.process)
    return found


def subscriber(built: Path, core: RosCore, name: str) -> subprocess.Popen[str]:
    """Start a roscpp node that subscribes to the large images."""
    remapped = [f"__name:={name}", f"/{name}/image:=/big"]
    return start([str(built / "roscpp_peer"), "listen", *remapped], core.env, stdout=subprocess.DEVNULL)


def stopped_rounds(built: Path, folder: Path, rounds: int) -> list[tuple[float, float]]:
    """Return medians with a running subscriber, and with an additional stopped one."""
    found = []
    with RosCore(folder) as core:
        simulator = Simulator(built, core, AT_50_HZ)
        live = subscriber(built, core, "live")
        for _ in range(rounds):
            medians = []
            for is_stopped in (False, True):
                second = subscriber(built, core, "second")
                time.sleep(SETTLED)
                second.send_signal(signal.SIGSTOP if is_stopped else signal.SIGKILL)
                simulator.times()
                time.sleep(LOADED)
                medians.append(simulator.times()[0])
                second.kill()
                second.wait()
            found.append((medians[0], medians[1]))
        stop(live)
        simulator.end()
    return found


def report(what: str, rounds: list[tuple[float, float]]) -> None:
    """Print a line of the table."""
    calm, disturbed = (statistics.median(column) for column in zip(*rounds, strict=True))
    ratio = statistics.median(after / before for before, after in rounds)
    print(f"{what:40}{calm:10.1f}{disturbed:10.1f}{ratio:8.2f}", flush=True)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description="Measure the effect of network problems on simulation steps.")
    parser.add_argument("built", type=Path, help="folder of the built programs")
    parser.add_argument("--rounds", type=int, default=20, help="number of rounds (default 20)")
    options = parser.parse_args()
    print(f"{'us':40}{'without':>10}{'with':>10}{'ratio':>8}")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        report("master restarts, 99th percentile", master_rounds(options.built, folder, options.rounds))
        report("stopped subscriber, median", stopped_rounds(options.built, folder, options.rounds))


if __name__ == "__main__":
    main()
