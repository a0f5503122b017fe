#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Drive the tricycle around obstacles over TCP: sends "steering;speed", receives "time;distance". Does not need ROS."""

import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C while modules are loaded shows no traceback

import argparse
import math
import socket
import sys
import time

from bubblesim.controllers.tricycle_avoid import TricycleAvoid
from bubblesim.program.run import run_program

TIMEOUT = 5.0  # s, timeout of the connection and of answers


def drive(connection: socket.socket) -> None:
    """Send commands and receive measurements until the simulation closes the connection."""
    answers = connection.makefile("r", encoding="ascii", newline="\n")
    controller = TricycleAvoid()
    steering, speed = 0.0, 0.0
    last_time = None
    while True:
        connection.sendall(f"{steering:.4f};{speed:.4f}\n".encode())
        answer = answers.readline()
        if not answer:
            return
        now, distance = (float(number) for number in answer.split(";"))
        command = controller.update(distance or math.inf, now - (now if last_time is None else last_time))
        last_time = now
        if command is not None:
            steering, speed = command.steering, command.speed


def halt(connection: socket.socket) -> None:
    """Stop the tricycle and wait until the simulation has read that.

    A connection that is closed with unread answers is reset, and the simulation may lose the command.
    """
    connection.sendall(b"0;0\n")
    connection.shutdown(socket.SHUT_WR)
    while connection.recv(4096):
        pass


def connect(host: str, port: int) -> socket.socket:
    """Connect to the simulation, which may still be starting."""
    deadline = time.monotonic() + TIMEOUT
    while True:
        try:
            return socket.create_connection((host, port), timeout=TIMEOUT)
        except ConnectionRefusedError:
            if time.monotonic() > deadline:
                raise
            time.sleep(0.1)


def main() -> int:
    """Run until Ctrl-C or the end of the simulation; return 1 if there is none."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--host", default="127.0.0.1", help="host of the simulation (default %(default)s)")
    parser.add_argument("--port", type=int, default=5000, help="port of the simulation (default %(default)s)")
    options = parser.parse_args()
    address = f"{options.host}:{options.port}"
    print(f"waiting for the simulation at {address}, at most {TIMEOUT:g} s; press Ctrl-C to end", flush=True)
    signal.signal(signal.SIGINT, signal.default_int_handler)  # stop the tricycle on Ctrl-C
    try:
        with connect(options.host, options.port) as connection:
            print(f"driving the tricycle at {address}; press Ctrl-C to end", flush=True)
            try:
                drive(connection)
            except KeyboardInterrupt:
                halt(connection)
                return 0
            print("the simulation has ended")
            return 0
    except ConnectionRefusedError:
        print(
            f"error: connection refused at {address} for {TIMEOUT:g} s; start `rosrun bubblesim sim tricycle_socket`",
            file=sys.stderr,
        )
    except TimeoutError:
        print(f"error: no answer from {address} for {TIMEOUT:g} s; is the simulation paused?", file=sys.stderr)
    except (OSError, ValueError) as error:
        print(f"error: {address}: {error}", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(run_program(main))
