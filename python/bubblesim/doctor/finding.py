# SPDX-License-Identifier: BSD-3-Clause
"""Findings of checks."""

from __future__ import annotations

import enum
from dataclasses import dataclass


class Level(enum.Enum):
    """Severity of a finding."""

    OK = "ok"
    WARNING = "warning"  # an optional feature does not work
    PROBLEM = "problem"


@dataclass(frozen=True)
class Finding:
    """A result of a check, and how to fix it if it is not ok."""

    level: Level
    text: str
    cure: str = ""


def ok(text: str) -> Finding:
    """Return a finding: ok."""
    return Finding(Level.OK, text)


def warning(text: str, cure: str) -> Finding:
    """Return a finding: an optional feature does not work."""
    return Finding(Level.WARNING, text, cure)


def problem(text: str, cure: str) -> Finding:
    """Return a finding: something does not work."""
    return Finding(Level.PROBLEM, text, cure)
