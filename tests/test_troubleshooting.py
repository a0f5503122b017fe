# SPDX-License-Identifier: BSD-3-Clause
"""The messages on the page of troubleshooting are those of the programs."""

import re
from collections.abc import Iterator

from ros_support import REPOSITORY

PAGE = REPOSITORY / "docs" / "troubleshooting.md"
ROW = re.compile(r"^\| `([^`]+)`(?: \([^)]*\))? \| ", re.MULTILINE)
# What a message has of the case: names, numbers, addresses, reasons of the system. It is written in parts between them.
VARIABLE = re.compile(
    r"<?\b[A-Z]{4,}(?:/[A-Z]+)*\b>?|/sim_ros_interface|/clock|\.\.\.|\b\d[\d.:]*\b|\bmapper\b|'|JavaScript|<pose>|\byaw\b"
    r"|on port|: Address already in use"
)


def sources() -> Iterator[str]:
    for folder in ("python", "src", "scripts"):
        for file in (REPOSITORY / folder).rglob("*"):
            if file.is_file() and file.suffix in ("", ".py", ".cpp", ".hpp", ".lua", ".bash"):
                yield file.read_text(errors="replace")


def test_messages_of_the_page_are_in_the_sources() -> None:
    # Strings may be broken over two lines.
    text = re.sub(r'"\s*\n\s*f?"', "", "\n".join(sources()))
    messages = ROW.findall(PAGE.read_text())
    assert len(messages) > 15
    missing = [
        (message, part)
        for message in messages
        for part in map(str.strip, VARIABLE.split(message))
        if len(part) > 3 and part not in text
    ]
    assert missing == []
