# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim doctor: diagnose the installation and suggest fixes."""

from __future__ import annotations

import argparse
import itertools
import sys
from typing import Any

from bubblesim.cli.terminal import painted

_ABOUT = ("build", "messages", "ros", "ports")
_COLORS = {"ok": "green", "warning": "yellow", "problem": "red"}


def add_parser(commands: Any) -> None:
    """Add the command's arguments."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "doctor",
        help="diagnose problems of the installation",
        description="Checks the environment of this terminal: Python, the build, message types, the ROS master, "
        "network names, ports. Prints each problem with the command that fixes it. Without ABOUT, checks all.",
        epilog="exit codes: 0 no problems, or only warnings about optional features; 1 problems found",
    )
    parser.add_argument("about", nargs="*", metavar="ABOUT", help=", ".join(_ABOUT))
    parser.set_defaults(command=_examine, parser=parser)


def _examine(options: argparse.Namespace) -> int:
    from bubblesim.doctor import build_checks, message_checks, port_checks, ros2_checks, ros_checks
    from bubblesim.doctor.finding import Level

    checks = {
        "build": (build_checks.check_python, build_checks.check_package, build_checks.check_node),
        "messages": (message_checks.check_messages,),
        "ros": (ros_checks.check_names, ros_checks.check_master, ros2_checks.check_ros2),
        "ports": (port_checks.check_ports,),
    }
    unknown = [about for about in options.about if about not in checks]
    if unknown:
        raise ValueError(f"unknown check '{unknown[0]}'; the checks are {', '.join(checks)}")
    problems = False
    for check in itertools.chain.from_iterable(checks[about] for about in options.about or _ABOUT):
        for finding in check():
            level = finding.level.value
            print(f"{painted(f'{level:8}', _COLORS[level], sys.stdout)} {finding.text}")
            if finding.cure:
                print(f"{'':8} fix: {finding.cure}")
            problems = problems or finding.level is Level.PROBLEM
            sys.stdout.flush()
    return int(problems)
