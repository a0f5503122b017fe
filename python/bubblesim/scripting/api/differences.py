# SPDX-License-Identifier: BSD-3-Clause
"""How functions for scripts differ from CoppeliaSim's, for `bubblesim api`, the reference pages and the editor."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any, TypeVar

Function = TypeVar("Function", bound=Callable[..., Any])

_WITHOUT_EFFECT = ("Accept ", "Do nothing")  # beginnings of the documentation of what is only called here
_REFUSAL = "it changes any object; here an object held by physics or the file stays as it is, with a warning"


def differs(how: str) -> Callable[[Function], Function]:
    """State what CoppeliaSim's function does that this one does not, and what this one does; without a full stop."""

    def mark(function: Function) -> Function:
        function.differs = how  # type: ignore[attr-defined]
        return function

    return mark


def difference(function: Callable[..., Any]) -> str:
    """Return how a function differs; an empty string if it does what CoppeliaSim's manual states."""
    if stated := getattr(function, "differs", ""):
        return str(stated)
    if hasattr(function, "refusal_warns"):
        return _REFUSAL
    if (inspect.getdoc(function) or "").startswith(_WITHOUT_EFFECT):
        return "it has an effect; here the call is accepted so that scripts go on"
    return ""
