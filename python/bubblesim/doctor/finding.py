# SPDX-License-Identifier: BSD-3-Clause
"""What a check has found."""

from __future__ import annotations

import enum
from dataclasses import dataclass


class Level(enum.Enum):
    """How bad it is."""

    OK = "ok"
    WARNING = "warning"  # something does not work that many do not need
    PROBLEM = "problem"


@dataclass(frozen=True)
class Finding:
    """What is so, and what to do about it unless it is well."""

    level: Level
    text: str
    cure: str = ""


def ok(text: str) -> Finding:
    """That all is well."""
    return Finding(Level.OK, text)


def warning(text: str, cure: str) -> Finding:
    """That something does not work that many do not need."""
    return Finding(Level.WARNING, text, cure)


def problem(text: str, cure: str) -> Finding:
    """That something does not work."""
    return Finding(Level.PROBLEM, text, cure)
