# SPDX-License-Identifier: BSD-3-Clause
"""The program bubblesim: select a command and run it."""

from __future__ import annotations

import argparse
import difflib
import importlib
import sys
from collections.abc import Sequence

from bubblesim.messages.names import did_you_mean
from bubblesim.program.run import run_program
from bubblesim.running.processes import RunError

_COMMANDS = (
    "demo",
    "run",
    "shell",
    "scenes",
    "new-scene",
    "new-plugin",
    "check",
    "describe",
    "convert",
    "api",
    "test",
    "sweep",
    "view",
    "ps",
    "bridge",
    "compat",
    "doctor",
)
_OPTIONS = ("--version", "--help", "-h")
_ELSEWHERE = {"help": "bubblesim --help", "add-message": "rosrun bubblesim add_message"}
_FAILED, _BAD_INPUT = 1, 2

_DESCRIPTION = """\
Runs robot scenes and helps to write them. Begin with:

  bubblesim demo                         see a tricycle drive
  bubblesim scenes                       list the scenes
  bubblesim run tricycle --roscore       run one, with a ROS master
  bubblesim shell tricycle --no-ros      a Python prompt with `sim`
  bubblesim new-scene mine               create a new scene
  bubblesim new-plugin mine --python     create a package with a plugin of your own
  bubblesim check my/robot.sdf           validate a file
  bubblesim describe scene.ttt           show what a file of CoppeliaSim has
  bubblesim convert scene.ttt folder     write it as SDFormat
  bubblesim api getObject                show a function for scripts
  bubblesim test test_mine.py            test a controller in the simulator
  bubblesim sweep mine.py --seeds 0:99   run over seeds and parameters
  bubblesim view                         open the window of a running simulation
  bubblesim ps                           list your simulators on this machine
  bubblesim bridge                       pass topics between ROS 1 and ROS 2
  bubblesim compat                       list the packages for launch files of Gazebo
  bubblesim doctor                       diagnose problems of ROS or Python"""
_EPILOG = """\
exit codes: 0 success, 1 a check or a run failed, or stdout is full or closed, 2 bad input; `run` returns those of the
node. Data goes to stdout, everything else to stderr. NO_COLOR=1 disables colours."""


def program() -> int:
    """Run as the program of the wheel, which has no ROS; return the exit code."""
    try:
        return run_program(main)
    except ModuleNotFoundError as error:
        if (error.name or "bubblesim").startswith("bubblesim"):
            raise
        print(
            f"error: this command needs the Python module {error.name}: install it, or use a build with ROS",
            file=sys.stderr,
        )
        return _FAILED


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command given by the arguments (default: those of the process); return the exit code."""
    parser = argparse.ArgumentParser(
        prog="bubblesim",
        description=_DESCRIPTION,
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.add_argument("--version", action="store_true", help="print the version, and the commit of a package")
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    given = list(sys.argv[1:] if arguments is None else arguments)
    if given[:1] == ["--version"]:
        from bubblesim import _core

        print(f"bubblesim {_core.__version__}")
        return 0
    if given[:1] and given[0] not in _COMMANDS and given[0] not in _OPTIONS:
        parser.error(_unknown(given[0]))
    # Add only the requested command if it is known: some commands load slowly.
    for command in given[:1] if given[:1] and given[0] in _COMMANDS else _COMMANDS:
        importlib.import_module(f"bubblesim.cli.{command.replace('-', '_')}").add_parser(commands)
    options, others = parser.parse_known_args(given)
    if others and "other_options" not in options:
        options.parser.error(f"unrecognized arguments: {' '.join(others)}")
    options.other_options = others
    options.all_arguments = given
    try:
        code: int = options.command(options)
    except ValueError as error:  # includes SceneError
        print(f"error: {error}", file=sys.stderr)
        return _BAD_INPUT
    except RunError as error:
        print(f"error: {error}", file=sys.stderr)
        return _FAILED
    return code


def _unknown(word: str) -> str:
    """Return the error for a first word that is neither a command nor an option."""
    if word.startswith("-"):
        near = did_you_mean(difflib.get_close_matches(word, _OPTIONS, n=1))
        return f"there is no option '{word}'{near or '; options follow a command: bubblesim COMMAND [option ...]'}"
    if word.replace("_", "-") in _ELSEWHERE:
        return f"there is no command '{word}'; did you mean `{_ELSEWHERE[word.replace('_', '-')]}`?"
    near = did_you_mean(difflib.get_close_matches(word, _COMMANDS, n=2))
    return f"there is no command '{word}'{near or '; the commands are ' + ', '.join(_COMMANDS)}"
