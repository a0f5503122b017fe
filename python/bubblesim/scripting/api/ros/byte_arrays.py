# SPDX-License-Identifier: BSD-3-Clause
"""uint8[] of messages that scripts receive: bytes in Python; in Lua tables, or strings where a script wants them."""

from __future__ import annotations

from typing import Any

from bubblesim.scripting.caller import Caller


class ByteArrays:
    """Which endpoints of a script deliver uint8[] as strings in Lua, too."""

    def __init__(self, caller: Caller) -> None:
        """Bind to a script."""
        self._caller = caller
        self._as_strings: set[int] = set()

    def deliver_strings(self, endpoint: int) -> None:
        """Deliver strings from now on."""
        self._as_strings.add(endpoint)

    def forget(self, endpoint: int) -> None:
        """Forget an endpoint that was shut down."""
        self._as_strings.discard(endpoint)

    def received(self, endpoint: int, message: Any) -> Any:
        """Return a message as the script gets it."""
        return _without_bytes(message) if self._caller.in_lua and endpoint not in self._as_strings else message


def _without_bytes(value: Any) -> Any:
    """Return a message with lists of integers in place of bytes."""
    if isinstance(value, bytes):
        return list(value)
    if isinstance(value, dict):
        return {name: _without_bytes(field) for name, field in value.items()}
    if isinstance(value, list) and value and isinstance(value[0], dict | bytes):
        return [_without_bytes(each) for each in value]
    return value
