#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Teleoperation with the keys of a terminal: Twist on cmd_vel.

Parameters: ~speed (m/s), ~turn (rad/s), ~speed_limit, ~turn_limit, ~rate (Hz of the commands while driving),
~key_timeout (s without a key press after which the robot stops), ~stamped (TwistStamped instead), ~frame_id.
"""

import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C while modules are loaded shows no traceback

import argparse
import contextlib
import os
import select
import sys
import termios
import time
import tty
from collections.abc import Iterator

import rospy

from bubblesim.nodes.run_node import run_ros_program
from bubblesim.nodes.twist_commands import TwistCommands
from bubblesim.teleop.keyboard_teleop import HELP, KeyboardTeleop


@contextlib.contextmanager
def keys_one_by_one() -> Iterator[None]:
    """Switch the terminal to cbreak mode without echo, and restore it afterwards."""
    before = termios.tcgetattr(sys.stdin)
    try:
        tty.setcbreak(sys.stdin)
        yield
    finally:
        termios.tcsetattr(sys.stdin, termios.TCSADRAIN, before)


def keys_within(seconds: float) -> str:
    """Return the keys that are pressed within a time; return early with the first key."""
    readable, _, _ = select.select([sys.stdin], [], [], seconds)
    # Not with sys.stdin.read(): it buffers more than it returns, and select() does not see the rest.
    return os.read(sys.stdin.fileno(), 64).decode(errors="replace") if readable else ""


def drive(teleop: KeyboardTeleop, commands: TwistCommands, period: float) -> None:
    """Publish commands at a constant rate while driving, and one to stop, until shutdown."""
    print(f"{HELP}\n{speeds(teleop)}", flush=True)
    while not rospy.is_shutdown():
        keys = keys_within(period)
        changes = [teleop.press(key, time.monotonic()) for key in keys]
        if any(changes):
            print(speeds(teleop), flush=True)
        velocity = teleop.velocity(time.monotonic())
        if keys:
            commands.publish(velocity)
        else:
            commands.follow(velocity)


def speeds(teleop: KeyboardTeleop) -> str:
    """Return the speeds as a line of text."""
    return f"speed {teleop.speed:.3g} m/s   turn {teleop.turn:.3g} rad/s"


def main() -> int:
    """Run the node until shutdown; return 2 without a terminal."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--latch", action="store_true", help="drive on until another key is pressed")
    options = parser.parse_args(rospy.myargv(sys.argv)[1:])
    if not sys.stdin.isatty():
        print("error: stdin is not a terminal: start this node with rosrun in a terminal", file=sys.stderr)
        return 2
    rospy.init_node("teleop_twist_keyboard")
    teleop = KeyboardTeleop(
        speed=float(rospy.get_param("~speed", 0.5)),
        turn=float(rospy.get_param("~turn", 1.0)),
        speed_limit=float(rospy.get_param("~speed_limit", 1000.0)),
        turn_limit=float(rospy.get_param("~turn_limit", 1000.0)),
        timeout=None if options.latch else float(rospy.get_param("~key_timeout", 0.6)),
    )
    with keys_one_by_one():
        drive(teleop, TwistCommands(), 1.0 / float(rospy.get_param("~rate", 10.0)))
    return 0


if __name__ == "__main__":
    sys.exit(run_ros_program(main))
