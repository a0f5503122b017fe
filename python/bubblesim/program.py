# SPDX-License-Identifier: BSD-3-Clause
"""How the programs of bubblesim end: by Ctrl-C without a traceback, and not well when their output is lost."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable

FAILED = 1
BY_CTRL_C = 130  # as a shell calls a program that SIGINT has ended
BY_CLOSED_PIPE = 141  # and SIGPIPE


def run_program(main: Callable[[], int]) -> int:
    """Run a program; its exit code: that of ``main``, unless what it printed could not be written."""
    _replace_closed_output()
    try:
        code = _exit_code(main)
        sys.stdout.flush()
    except KeyboardInterrupt:
        return BY_CTRL_C
    except BrokenPipeError:  # the reader has seen enough, as `head` does
        _discard_output()
        return BY_CLOSED_PIPE
    except OSError as error:
        _discard_output()
        print(f"error: {error.filename or 'output'}: {error.strerror}", file=sys.stderr)
        return FAILED
    return code


def _exit_code(main: Callable[[], int]) -> int:
    try:
        return main()
    except SystemExit as end:  # argparse's, after the help
        if isinstance(end.code, str):
            print(end.code, file=sys.stderr)
            return FAILED
        return end.code or 0


def _replace_closed_output() -> None:
    """Without stdout, print() does nothing; what is printed here fails."""
    if sys.stdout is None:
        sys.stdout = os.fdopen(os.open(os.devnull, os.O_RDONLY), "w")


def _discard_output() -> None:
    """What is still to be written when the interpreter ends goes nowhere."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
