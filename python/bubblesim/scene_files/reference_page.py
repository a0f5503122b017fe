# SPDX-License-Identifier: BSD-3-Clause
"""What the programs that write reference pages share."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable


def markdown_table(head: tuple[str, ...], rows: Iterable[list[str]]) -> str:
    """Return a table as Markdown."""
    lines: list[Iterable[str]] = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in lines) + "\n"


def print_page(module: str, page: Callable[[], str]) -> int:
    """Print a page and return 0; return 2 if the program has arguments, of which it takes none."""
    if len(sys.argv) != 1:
        print(f"usage: python -m {module}", file=sys.stderr)
        return 2
    print(page(), end="")
    return 0
