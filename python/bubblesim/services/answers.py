# SPDX-License-Identifier: BSD-3-Clause
"""Error handling of services."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bubblesim import _core

Message = dict[str, Any]


def report_errors(answer: Callable[[Message], Message]) -> Callable[[Message], Message]:
    """Report errors in the response's fields success and status_message."""

    def guarded(request: Message) -> Message:
        try:
            return {"success": True, **answer(request)}
        except (LookupError, ValueError, RuntimeError) as error:
            return {"success": False, "status_message": str(error)}

    return guarded


def failing(answer: Callable[[Message], Message]) -> Callable[[Message], Message]:
    """Let the call fail with the error message, because a response would contain meaningless values."""

    def guarded(request: Message) -> Message:
        try:
            return answer(request)
        except (LookupError, ValueError, RuntimeError) as error:
            raise _core.ServiceError(str(error)) from None

    return guarded


def answering_empty(action: Callable[[], None]) -> Callable[[object], None]:
    """Return the handler of a std_srvs/Empty service; the call fails on errors, because the response has no fields."""

    def answer(request: object) -> None:
        try:
            action()
        except RuntimeError as error:  # called by a script during a step
            raise _core.ServiceError(str(error)) from None

    return answer
