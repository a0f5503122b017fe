# SPDX-License-Identifier: BSD-3-Clause
"""Compare subscribing and publishing in a child script with equivalent roscpp and rospy nodes.

    python benchmarks/traffic/traffic.py BUILD/devel/lib/bubblesim [--rounds N]

Source the workspace and start a roscore first. In each round a roscpp node publishes to each of the nodes in turn, and
the other nodes are stopped. Prints medians over the rounds, and of the ratios in each round:

- CPU time of a whole receiving process per message; the simulator runs in real time, with 20 steps per second
- the round trip of a Twist to the node and back, with a simulator that runs as fast as possible: it delivers messages
  once per simulation step, so in real time a message waits for the next step
- one call of a publisher without subscribers
"""

from __future__ import annotations

import argparse
import ctypes
import signal
import statistics
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

HERE = Path(__file__).parent
TRAFFIC = {"twist": (400, 200.0), "scan": (400, 200.0), "image": (100, 50.0), "cloud": (100, 50.0)}
"""Number of messages of a type to a receiver per round, and their rate in Hz."""
PINGS = 300
SETTLED = 0.2  # s after which a node has processed all messages

LIBC = ctypes.CDLL(None)


class Peer:
    """A process that is stopped except in its turn."""

    def __init__(self, *command: object) -> None:
        """Start the process."""
        self.process = subprocess.Popen(
            [str(word) for word in command], text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=1
        )
        self._clock = ctypes.c_int()
        LIBC.clock_getcpuclockid(self.process.pid, ctypes.byref(self._clock))

    def cpu_seconds(self) -> float:
        """Return the CPU time of all its threads so far."""
        return time.clock_gettime(self._clock.value)

    @contextmanager
    def turn(self) -> Iterator[None]:
        """Let the process run during the block."""
        self.process.send_signal(signal.SIGCONT)
        yield
        self.process.send_signal(signal.SIGSTOP)

    def ask(self, *command: object) -> str:
        """Send a line and return the answer."""
        assert self.process.stdin
        assert self.process.stdout
        print(*command, file=self.process.stdin)
        return self.process.stdout.readline().strip()

    def end(self) -> str:
        """End the process and return its output."""
        self.process.send_signal(signal.SIGCONT)
        self.process.send_signal(signal.SIGINT)
        return self.process.communicate()[0]


def simulator(built: Path, script: str) -> list[object]:
    """Return the command of a simulator with an empty scene and a script."""
    return [built / "sim", HERE / "empty.sdf", "--strict", "--child-script", f"/Peer={HERE / script}"]


def receive(driver: Peer, peers: dict[str, Peer], kind: str) -> dict[str, float]:
    """Return the microseconds of CPU time of each receiver per message, in one round."""
    count, rate = TRAFFIC[kind]
    spent = {}
    for name, peer in peers.items():
        with peer.turn():
            driver.ask("send", kind, f"/{name}", 1, rate)  # connects, and wakes up the process
            time.sleep(SETTLED)
            before = peer.cpu_seconds()
            driver.ask("send", kind, f"/{name}", count, rate)
            time.sleep(SETTLED)
            spent[name] = (peer.cpu_seconds() - before) / count * 1e6
    return spent


def round_trip(driver: Peer, peers: dict[str, Peer]) -> dict[str, float]:
    """Return the microseconds from a ping to its echo for each node, in one round."""
    took = {}
    for name, peer in peers.items():
        with peer.turn():
            took[name] = float(driver.ask("ping", f"/{name}", PINGS))
    return took


def report(what: str, rounds: list[dict[str, float]]) -> None:
    """Print a line of the table."""
    ours = rounds[0].keys() - {"roscpp", "rospy"}
    assert len(ours) == 1
    name = ours.pop()
    line = f"{what:34}{statistics.median(took[name] for took in rounds):9.1f}"
    for peer in ("roscpp", "rospy"):
        ratio = statistics.median(took[name] / took[peer] for took in rounds)
        line += f"{statistics.median(took[peer] for took in rounds):9.1f}{ratio:7.2f}"
    print(line, flush=True)


def check_counts(peers: dict[str, Peer], rounds: int) -> None:
    """End the receivers, and check that each has received all messages."""
    expected = {kind: str(rounds * (count + 1)) for kind, (count, _) in TRAFFIC.items()}
    for name, peer in peers.items():
        found = dict(line.split() for line in peer.end().splitlines() if line.split()[0] in TRAFFIC)
        assert found == expected, f"{name} received {found} of {expected}"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description="Compare the messages of a child script with roscpp and rospy nodes.")
    parser.add_argument("built", type=Path, help="folder of the built programs")
    parser.add_argument("--rounds", type=int, default=11, help="number of rounds (default 11)")
    options = parser.parse_args()

    driver = Peer(options.built / "roscpp_peer", "drive")
    others = {
        "roscpp": Peer(options.built / "roscpp_peer", "listen"),
        "rospy": Peer("/usr/bin/python3", HERE / "rospy_peer.py"),
    }
    real_time = Peer(*simulator(options.built, "script_peer.py"), "__name:=real_time")
    fast = Peer(*simulator(options.built, "script_peer.py"), "__name:=fast", "--speed", "max")
    receivers = {"real_time": real_time, **others}
    echoes = {"fast": fast, **others}
    for peer in (fast, *receivers.values()):
        peer.process.send_signal(signal.SIGSTOP)

    print(f"{'us, median':34}{'script':>9}{'roscpp':>9}{'ratio':>7}{'rospy':>9}{'ratio':>7}")
    for kind in TRAFFIC:
        report(f"CPU time to receive: {kind}", [receive(driver, receivers, kind) for _ in range(options.rounds)])
    report("round trip: twist", [round_trip(driver, echoes) for _ in range(options.rounds)])
    check_counts(receivers, options.rounds)
    for peer in (fast, driver):
        peer.process.kill()
    command = [*map(str, simulator(options.built, "script_unheard.py")), "--until", "0.1"]
    unheard = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout
    print(f"{'publish without subscribers':34}{float(unheard):9.2f}")


if __name__ == "__main__":
    main()
