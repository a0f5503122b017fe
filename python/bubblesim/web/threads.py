# SPDX-License-Identifier: BSD-3-Clause
"""Work in threads that does not outlive the task that asked for it."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import TypeVar

Result = TypeVar("Result")


async def in_thread(function: Callable[..., Result], *arguments: object) -> Result:
    """Call a function in a thread and return its result.

    A thread cannot be cancelled: a task that is cancelled meanwhile waits for its end, and can then undo its work.
    """
    work = asyncio.ensure_future(asyncio.to_thread(function, *arguments))
    cancelled = False
    while not work.done():
        try:
            await asyncio.wait([work])
        except asyncio.CancelledError:
            cancelled = True
    if cancelled:
        work.exception()  # no task waits for it any more
        raise asyncio.CancelledError
    return work.result()
