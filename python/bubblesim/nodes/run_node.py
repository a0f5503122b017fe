# SPDX-License-Identifier: BSD-3-Clause
"""The life of a rospy node."""

from __future__ import annotations

import argparse
import sys
import threading
from collections.abc import Callable
from typing import TypeVar

import rospy

from bubblesim.program import run_program

Node = TypeVar("Node")


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
