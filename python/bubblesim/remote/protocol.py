# SPDX-License-Identifier: BSD-3-Clause
"""The messages of CoppeliaSim's remote API, protocol version 2: CBOR maps."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

from bubblesim._core import cbor_decode, cbor_encode

MOST_BYTES = 64 * 1024 * 1024
EXECUTED = "_*executed*_"
END = "_*end*_"
_NIL = "_*NIL*_"
_CALLBACK = "@func"
_DEFAULT_TIMEOUT = 600.0  # s
_LONGEST_TIMEOUT = 86400.0


class RequestError(ValueError):
    """A message that is not a request."""


class Reply(bytes):
    """A reply that is encoded already."""


class Request(NamedTuple):
    """A call of a function by a client."""

    function: str
    arguments: list[Any]
    uuid: str
    """Empty if the client sends none."""
    timeout: float | None
    """s of silence after which the client is forgotten; only in the first request."""
    token: Any
    """Which lets the client in; None if it sends none."""


def decode(data: bytes) -> Request:
    """Return the request in a message.

    :raises RequestError: for everything else; nothing is allocated that the message does not contain.
    """
    if len(data) > MOST_BYTES:
        raise RequestError(f"a message of {len(data)} bytes: at most {MOST_BYTES} are accepted")
    try:
        message = cbor_decode(data)
    except ValueError as error:
        raise RequestError(f"the message is not a CBOR map: {error}") from None
    if not isinstance(message, dict) or not isinstance(message.get("func"), str):
        raise RequestError("the message is not a map with the string 'func'")
    arguments = message.get("args")
    if arguments is None:
        arguments = []
    if not isinstance(arguments, list):
        raise RequestError(f"'args' is not a list but of type {type(arguments).__name__}")
    uuid = message.get("uuid", "")
    if not isinstance(uuid, str) or len(uuid) > 200:
        raise RequestError("'uuid' is not a string of at most 200 characters")
    return Request(message["func"], arguments, uuid, _timeout(message.get("timeout")), message.get("token"))


def _timeout(value: Any) -> float | None:
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    return min(max(float(value), 1.0), _LONGEST_TIMEOUT) if value == value else _DEFAULT_TIMEOUT


def callback_name(value: Any) -> str | None:
    """Return the client's name of a function among the arguments; None for other values."""
    return value.removesuffix(_CALLBACK) if isinstance(value, str) and value.endswith(_CALLBACK) else None


def is_nil(value: str) -> bool:
    """Return whether an argument stands for nil."""
    return value == _NIL


def result(value: Any) -> bytes:
    """Return the reply with the result of a function; a tuple is several results."""
    values = [] if value is None else list(value) if isinstance(value, tuple) else [value]
    return encode({"ret": values})


def error(text: str) -> bytes:
    """Return the reply with an error."""
    return encode({"err": text.encode(errors="backslashreplace").decode()})


def error_of(raised: Exception) -> bytes:
    """Return the reply with the error that a function has raised."""
    return error(str(raised) or type(raised).__name__)


def call(function: str, arguments: Iterable[Any]) -> bytes:
    """Return the message that lets the client call its function; raise TypeError as ``encode``."""
    return encode({"func": function, "args": list(arguments)})


def encode(message: Any) -> bytes:
    """Return the bytes of a message; raise TypeError for values that have no counterpart in the client."""
    data: bytes = cbor_encode(message)
    return data
