# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim view: open the window of a node that runs."""

from __future__ import annotations

import argparse
from typing import Any

_DESCRIPTION = """\
Opens the window of a simulation in the browser, beside a node that was started with --remote or --web. Prints the
address. It carries a token: anyone who has it can run programs as you (with --read-only: can see it).

What is not printed to a terminal has no token: there, open the file that is named. BUBBLESIM_WEB_TOKEN sets the token.

  bubblesim run tricycle --roscore --remote            in one terminal
  bubblesim view                                       in another one"""


def add_parser(commands: Any) -> None:
    """Add the command's arguments."""
    from bubblesim.web.program import add_arguments

    parser: argparse.ArgumentParser = commands.add_parser(
        "view",
        help="open the window of a running simulation in the browser",
        description=_DESCRIPTION,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    add_arguments(parser)
    parser.set_defaults(command=_view, parser=parser, browser=True)


def _view(options: argparse.Namespace) -> int:
    from bubblesim.web.program import serve

    return serve(options)
