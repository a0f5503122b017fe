#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Round trip of a call from CoppeliaSim's client, as a ratio to the same client against a bare echo of the same bytes.

usage: round_trip.py [--rounds 15] [--calls 200]; the test environment (scripts/setup --with tests) has the client. The
rounds of all servers are interleaved, because the speed of a machine varies.
"""

from __future__ import annotations

import argparse
import contextlib
import multiprocessing
import statistics
import subprocess
import time
from collections.abc import Callable, Iterator

import cbor2
import zmq
from coppeliasim_zmqremoteapi_client import RemoteAPIClient

from bubblesim.running.places import node_program

_PORT = 23900


def _echo(port: int) -> None:
    """Answer each request with the reply of getObjectPosition, without looking at it."""
    reply = cbor2.dumps({"ret": [[1.0, 2.0, 3.0]]})
    socket = zmq.Context().socket(zmq.REP)
    socket.bind(f"tcp://127.0.0.1:{port}")
    while True:
        socket.recv()
        socket.send(reply)


@contextlib.contextmanager
def _node(port: int, *options: str) -> Iterator[RemoteAPIClient]:
    command = [str(node_program()), "tricycle", "--no-ros", f"--remote={port}", *options]
    process = subprocess.Popen(command, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    try:
        yield RemoteAPIClient(port=port)
    finally:
        process.terminate()
        process.wait()


def _times(call: Callable[[], object], count: int) -> list[float]:
    times = []
    for _ in range(count):
        begin = time.perf_counter()
        call()
        times.append(time.perf_counter() - begin)
    return times


def _p99(times: list[float]) -> float:
    return sorted(times)[int(0.99 * len(times))]


def main() -> None:
    """Print medians, 99th percentiles and their ratios."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--calls", type=int, default=200, help="calls per round")
    options = parser.parse_args()
    echo = multiprocessing.Process(target=_echo, args=(_PORT,), daemon=True)
    echo.start()
    with contextlib.ExitStack() as stack:
        clients = {"echo": RemoteAPIClient(port=_PORT)}
        for number, state in enumerate(("stopped", "paused", "running"), start=1):
            clients[state] = stack.enter_context(_node(_PORT + number))
        handle = clients["stopped"].call("sim.getObject", ["/Tricycle"])
        for state in ("paused", "running"):
            clients[state].call("sim.startSimulation", [])
        clients["paused"].call("sim.pauseSimulation", [])
        times: dict[str, list[float]] = {name: [] for name in clients}
        for _ in range(options.rounds):
            for name, client in clients.items():
                times[name] += _times(lambda c=client: c.call("sim.getObjectPosition", [handle]), options.calls)
    echo.terminate()
    bare = times["echo"]
    print("server      median      p99   ratio of medians   ratio of p99")
    for name, values in times.items():
        middle, last = statistics.median(values), _p99(values)
        ratios = f"{middle / statistics.median(bare):18.2f} {last / _p99(bare):14.2f}"
        print(f"{name:8} {middle * 1e6:6.0f} us {last * 1e6:6.0f} us {ratios}")
    with _node(_PORT + 9, "--speed", "max") as client:  # alone: the others have ended
        handle = client.call("sim.getObject", ["/Tricycle"])
        client.call("sim.setStepping", [True])
        client.call("sim.startSimulation", [])
        begin = time.perf_counter()
        steps = 200
        for _ in range(steps):
            for _ in range(10):
                client.call("sim.getObjectPosition", [handle])
            client.call("sim.step", [])
        print(f"stepping with 10 calls a step: {0.05 * steps / (time.perf_counter() - begin):.1f} x real time")


if __name__ == "__main__":
    main()
