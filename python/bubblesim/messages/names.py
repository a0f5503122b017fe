# SPDX-License-Identifier: BSD-3-Clause
"""Names of message and service types."""

from __future__ import annotations

import difflib
import re

_NAME = re.compile(r"([a-z][a-z0-9_]*)/(?:(?:msg|srv)/)?([a-z][a-z0-9_]*)", re.IGNORECASE)
_LIKELY = 0.75  # minimum similarity, at most 1, for a suggestion


def type_name(text: str) -> str | None:
    """Return `package/Type`, also for `package/msg/Type` and `package/srv/Type`; None for other strings."""
    match = _NAME.fullmatch(text)
    return f"{match[1]}/{match[2]}" if match else None


def split_name(name: str) -> tuple[str, str]:
    """`geometry_msgs/Twist` -> ("geometry_msgs", "Twist"); `Twist` -> ("", "Twist")."""
    package, _, short = name.rpartition("/")
    return package, short


def nearest_names(name: str, known: list[str]) -> list[str]:
    """Return at most two known names similar to `name`, best first; its package may be missing."""
    package, short = split_name(name)

    def likeness(candidate: str) -> float:
        other_package, other_short = split_name(candidate)
        parts = [(short, other_short)] + ([(package, other_package)] if package else [])
        alike = sum(difflib.SequenceMatcher(None, a.lower(), b.lower()).ratio() for a, b in parts) / len(parts)
        return max(alike, _LIKELY) if other_short == short else alike  # same type name in another package

    # Package and type are compared separately: a long common package name does not make two types similar.
    ranked = sorted(((likeness(candidate), candidate) for candidate in known), key=lambda pair: (-pair[0], pair[1]))
    best = [pair for pair in ranked if pair[0] >= _LIKELY][:2]
    return [candidate for score, candidate in best if score > best[0][0] - 0.05]


def did_you_mean(candidates: list[str]) -> str:
    """Return the end of an error message; empty if there are no candidates."""
    return f"; did you mean {' or '.join(candidates)}?" if candidates else ""


def unknown_attribute(message: str) -> AttributeError:
    """Return the error of a __getattr__ whose message has a suggestion of ours.

    To an error without a name, Python adds that of the attribute, and its tracebacks, from 3.12 on, a suggestion.
    """
    return AttributeError(message, name="")
