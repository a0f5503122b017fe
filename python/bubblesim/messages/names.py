# SPDX-License-Identifier: BSD-3-Clause
"""Names of message and service types."""

from __future__ import annotations

import difflib
import re

_NAME = re.compile(r"([a-z][a-z0-9_]*)/(?:(?:msg|srv)/)?([a-z][a-z0-9_]*)", re.IGNORECASE)
_LIKELY = 0.75  # likeness, at most 1, from which on a name is worth mentioning


def type_name(text: str) -> str | None:
    """`package/Type`, also of `package/msg/Type` and `package/srv/Type`; None when the text is no type name."""
    match = _NAME.fullmatch(text)
    return f"{match[1]}/{match[2]}" if match else None


def split_name(name: str) -> tuple[str, str]:
    """`geometry_msgs/Twist` -> ("geometry_msgs", "Twist"); `Twist` -> ("", "Twist")."""
    package, _, short = name.rpartition("/")
    return package, short


def nearest_names(name: str, known: list[str]) -> list[str]:
    """At most two known names that a typo may have turned into `name`, best first; its package may be missing."""
    package, short = split_name(name)

    def likeness(candidate: str) -> float:
        other_package, other_short = split_name(candidate)
        parts = [(short, other_short)] + ([(package, other_package)] if package else [])
        alike = sum(difflib.SequenceMatcher(None, a.lower(), b.lower()).ratio() for a, b in parts) / len(parts)
        return max(alike, _LIKELY) if other_short == short else alike  # the right type of another package

    # Package and type are compared apart: a long package name alone must not make two types alike.
    ranked = sorted(((likeness(candidate), candidate) for candidate in known), key=lambda pair: (-pair[0], pair[1]))
    best = [pair for pair in ranked if pair[0] >= _LIKELY][:2]
    return [candidate for score, candidate in best if score > best[0][0] - 0.05]


def did_you_mean(candidates: list[str]) -> str:
    """The end of an error text; empty when there are no candidates."""
    return f"; did you mean {' or '.join(candidates)}?" if candidates else ""
