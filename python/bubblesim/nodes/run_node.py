# SPDX-License-Identifier: BSD-3-Clause
"""Running a rospy node."""

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

from bubblesim.program.addresses import stay_on_this_machine
from bubblesim.program.run import BY_CTRL_C, run_program

Node = TypeVar("Node")

_GRACE = 5.0  # s allowed for rospy's shutdown after a signal


def run_node(
    name: str, description: str | None, make: Callable[[], Node], run: Callable[[Node], object] = lambda _: rospy.spin()
) -> int:
    """Create a node and run it until shutdown; return its exit code: 2 for invalid parameters.

    :param make: reads the parameters and connects the topics; a ValueError is reported as an invalid parameter.
    """
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.parse_args(rospy.myargv(sys.argv)[1:])
    rospy.init_node(name)
    try:
        node = make()
    except (TypeError, ValueError, ZeroDivisionError) as error:
        rospy.logfatal(f"invalid parameter of {rospy.get_name()}: {error}")
        return 2
    run(node)
    return 0


def run_ros_program(main: Callable[[], int]) -> int:
    """Run the program of a node; return its exit code. Ctrl-C shows no traceback, also while waiting for a master."""
    _bound_the_shutdown()
    stay_on_this_machine(sys.argv)
    report = threading.excepthook

    def report_unless_ending(arguments: threading.ExceptHookArgs) -> None:
        if not (rospy.is_shutdown() and isinstance(arguments.exc_value, rospy.ROSException)):
            report(arguments)

    threading.excepthook = report_unless_ending

    def run() -> int:
        try:
            return main()
        except rospy.ROSException:  # raised in rospy's waiting functions at shutdown
            if rospy.is_shutdown():
                return 0
            raise

    return run_program(run)


def _bound_the_shutdown() -> None:
    """Limit the time to end after SIGINT or SIGTERM.

    rospy's signal handler calls the master through a proxy whose lock is not reentrant, so a signal during another call
    of the master blocks it forever. The wake-up descriptor is written before handlers run.
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
