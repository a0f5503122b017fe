# SPDX-License-Identifier: BSD-3-Clause
"""The life of a rospy node."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from typing import TypeVar

import rospy

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
