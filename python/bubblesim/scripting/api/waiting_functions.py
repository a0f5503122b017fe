# SPDX-License-Identifier: BSD-3-Clause
"""Functions that take several steps: generators that yield where the next step is to come."""

from __future__ import annotations

import functools
from collections.abc import Callable, Generator
from typing import Any, TypeVar, cast

from bubblesim.scripting.api.checked_calls import any_time

Waiting = Generator[None, None, Any]
"""Each ``next`` does the work of a step; the result is that of the function."""

Function = TypeVar("Function", bound=Callable[..., Any])


def waits(function: Function) -> Function:
    """Let a generator method of ``sim`` be called like the others: it returns after its last step.

    The method ``_run_waiting`` of its module runs it.
    """

    @functools.wraps(function)
    def call(self: Any, *arguments: Any) -> Any:
        return self._run_waiting(function.__name__, function(self, *arguments))

    call.waits = True  # type: ignore[attr-defined]
    return cast(Function, any_time(call))
