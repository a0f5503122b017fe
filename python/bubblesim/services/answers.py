# SPDX-License-Identifier: BSD-3-Clause
"""How services report what is wrong with a request."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bubblesim import _core

Message = dict[str, Any]


def report_errors(answer: Callable[[Message], Message]) -> Callable[[Message], Message]:
    """Report errors in the response's success and status_message, where callers look for them."""

    def guarded(request: Message) -> Message:
        try:
            return {"success": True, **answer(request)}
        except (LookupError, ValueError, RuntimeError) as error:
            return {"success": False, "status_message": str(error)}

    return guarded


def failing(answer: Callable[[Message], Message]) -> Callable[[Message], Message]:
    """Have the call fail with what is wrong: an answer would hide it among values that mean nothing."""

    def guarded(request: Message) -> Message:
        try:
            return answer(request)
        except (LookupError, ValueError, RuntimeError) as error:
            raise _core.ServiceError(str(error)) from None

    return guarded


def answering_empty(action: Callable[[], None]) -> Callable[[object], None]:
    """Make the answer of a std_srvs/Empty, which has no place to report errors in: the call fails then."""

    def answer(request: object) -> None:
        try:
            action()
        except RuntimeError as error:  # a script asks for it in the middle of a step
            raise _core.ServiceError(str(error)) from None

    return answer
