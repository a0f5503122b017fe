# SPDX-License-Identifier: BSD-3-Clause
"""The life of a rospy node."""

from __future__ import annotations

import argparse
import os
import signal
import socket
import sys
import threading
import time
from collections.abc import Callable
from typing import TypeVar

import rospy

from bubblesim.program import BY_CTRL_C, run_program

Node = TypeVar("Node")

_GRACE = 5.0  # s, that rospy's shutdown may take after a signal


def run_node(
    name: str, description: str | None, make: Callable[[], Node], run: Callable[[Node], object] = lambda _: rospy.spin()
) -> int:
    """Makes a node and runs it until it is told to stop; its exit code: 2 for parameters that cannot be used.

    :param make: reads the parameters and connects the topics; what it raises about a value is told as one of them.
    """
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.parse_args(rospy.myargv(sys.argv)[1:])
    rospy.init_node(name)
    try:
        node = make()
    except (TypeError, ValueError, ZeroDivisionError) as error:
        rospy.logfatal(f"a parameter of {rospy.get_name()} cannot be used: {error}")
        return 2
    run(node)
    return 0


def run_ros_program(main: Callable[[], int]) -> int:
    """Run the program of a node; its exit code. Ctrl-C shows no traceback, also while it waits for a master."""
    _bound_the_shutdown()
    report = threading.excepthook

    def report_unless_ending(arguments: threading.ExceptHookArgs) -> None:
        if not (rospy.is_shutdown() and isinstance(arguments.exc_value, rospy.ROSException)):
            report(arguments)

    threading.excepthook = report_unless_ending

    def run() -> int:
        try:
            return main()
        except rospy.ROSException:  # what waits in rospy ends by one
            if rospy.is_shutdown():
                return 0
            raise

    return run_program(run)


def _bound_the_shutdown() -> None:
    """End the process some seconds after SIGINT or SIGTERM at the latest.

    rospy's handler of signals calls the master through a proxy whose lock is not reentrant, so a signal that comes
    during another call of the master blocks it for ever. The wake-up descriptor is written before handlers run.
    """
    reader, writer = socket.socketpair()
    writer.setblocking(False)
    signal.set_wakeup_fd(writer.fileno(), warn_on_full_buffer=False)

    def wait_for_signal() -> None:
        with reader, writer:
            while reader.recv(1)[0] not in (signal.SIGINT, signal.SIGTERM):
                pass
            time.sleep(_GRACE)
            os._exit(BY_CTRL_C)

    threading.Thread(target=wait_for_signal, name="end after a signal", daemon=True).start()
