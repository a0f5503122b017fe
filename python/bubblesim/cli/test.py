# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim test: run regression tests of controllers."""

from __future__ import annotations

import argparse
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

_PASSED, _FAILED, _BAD_INPUT = 0, 1, 2
_EXAMPLE = """\
A test is a Python function, for example in test_mine.py:

  def test_it_keeps_clear_of_the_walls(sim, controller):
      controller("rosrun bubblesim tricycle_avoid.py")
      tricycle = sim("tricycle", lockstep=["/speed", "/steering"])
      tricycle.run(30.0)
      x, y, _ = tricycle.position("/Tricycle")
      assert abs(x) < 3 and abs(y) < 3

exit codes: 0 all passed, 1 some failed, 2 no tests found, or they could not be run"""


def add_parser(commands: Any) -> None:
    """Add the command's arguments."""
    parser: argparse.ArgumentParser = commands.add_parser(
        "test",
        help="test a controller in the simulator",
        description="Runs tests with pytest and fixtures that run the simulator in lockstep with a controller: `sim`, "
        "`controller` and `ros_master`; with ROS 2 `ros2_sim`, `ros2_controller` and `ros2_domain`. "
        "All options of pytest are accepted, such as -k NAME, -x and "
        "--junitxml=FILE. --keep-failed=FOLDER keeps the bags and logs of tests that fail, and a plot of the path.",
        epilog=_EXAMPLE,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        usage="bubblesim test FILE ... [option ...]",
        allow_abbrev=False,
    )
    parser.add_argument("files", nargs="+", metavar="FILE", help="a file of tests, or a folder of them")
    parser.set_defaults(command=_test, parser=parser, other_options=[])


def _test(options: argparse.Namespace) -> int:
    python = _python()
    if subprocess.run([python, "-c", "import pytest"], stderr=subprocess.DEVNULL, check=False).returncode:
        cure = f"{python} -m pip install pytest" if os.environ.get("VIRTUAL_ENV") else "apt-get install python3-pytest"
        print(f"error: {python} has no pytest: {cure}", file=sys.stderr)
        return _BAD_INPUT
    command = [python, "-m", "pytest", "-p", "bubblesim.testing.plugin", *options.files, *options.other_options]
    process = subprocess.Popen(command)
    # Ctrl-C and a closed terminal also reach pytest, which ends the programs it started; wait for that.
    for number in (signal.SIGINT, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    code = process.wait()
    return code if code in (_PASSED, _FAILED) else _BAD_INPUT


def _python() -> str:
    """Return the Python of the active virtual environment, which has the controller's packages."""
    active = Path(os.environ.get("VIRTUAL_ENV", ""), "bin", "python")
    return str(active) if os.environ.get("VIRTUAL_ENV") and active.is_file() else sys.executable
