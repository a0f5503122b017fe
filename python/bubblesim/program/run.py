# SPDX-License-Identifier: BSD-3-Clause
"""Exit codes of the programs of bubblesim: no traceback on Ctrl-C, failure if the output cannot be written."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable

FAILED = 1
BY_CTRL_C = 130  # exit code of a shell for a process ended by SIGINT
BY_CLOSED_PIPE = 141  # and by SIGPIPE


def run_program(main: Callable[[], int]) -> int:
    """Run a program; return the exit code of ``main``, or a failure if its output could not be written."""
    _replace_closed_output()
    try:
        code = _exit_code(main)
        sys.stdout.flush()
    except KeyboardInterrupt:
        return BY_CTRL_C
    except BrokenPipeError:  # the reader ended, as `head` does
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
    except SystemExit as end:  # raised by argparse, e.g. after the help
        if isinstance(end.code, str):
            print(end.code, file=sys.stderr)
            return FAILED
        return end.code or 0


def _replace_closed_output() -> None:
    """Replace a missing stdout by one that fails; otherwise print() would do nothing."""
    if sys.stdout is None:
        sys.stdout = os.fdopen(os.open(os.devnull, os.O_RDONLY), "w")


def _discard_output() -> None:
    """Redirect stdout to /dev/null, for the output flushed at exit."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
