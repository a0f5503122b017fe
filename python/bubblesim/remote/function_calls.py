# SPDX-License-Identifier: BSD-3-Clause
"""The function that a request means, with the arguments of the client, and the functions that clients have."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from bubblesim.remote import protocol
from bubblesim.remote.frame_publisher import layout
from bubblesim.remote.remote_client import RemoteCallback, RemoteClient
from bubblesim.remote.remote_sim import RemoteSim
from bubblesim.remote.window import functions as window_functions
from bubblesim.scripting.api.functions import functions


def carry_out(request: protocol.Request, sim: RemoteSim, client: RemoteClient) -> Any:
    """Call the function and return its result, which may be a Pending or a Conversation.

    :raises Exception: what the function raises, or that there is no such function.
    """
    module, _, name = request.function.partition(".")
    if module == "zmqRemoteApi" and name in ("require", "info"):
        wanted = request.arguments[0] if request.arguments else ""
        if wanted != "sim" and not (isinstance(wanted, str) and wanted.partition("-")[0] == "sim"):
            raise ImportError(f"module '{wanted}' not found: remote clients have the module sim")
        return None if name == "require" else info()
    if request.function == "frames.open":
        return client.server.publish_frames()
    if request.function == "frames.layout":
        return layout(client)
    if module == "window":
        return window_functions.call(client.server.host, client, name, request.arguments)
    if module != "sim" or name.startswith("_"):
        raise AttributeError(f"there is no function '{request.function}': remote clients have those of sim")
    function = getattr(sim, name)
    if not callable(function):
        raise TypeError(f"sim.{name} is a constant, not a function")
    arguments = [_argument(client, value) for value in request.arguments]
    while arguments and arguments[-1] is None:  # a trailing nil is an omitted argument
        arguments.pop()
    return function(*arguments)


def info() -> dict[str, dict[str, Any]]:
    """Return the functions and constants of `sim` as clients ask for them."""
    return {**{name: {"func": {}} for name in _function_names()}, **{name: {"const": v} for name, v in _constants()}}


def _function_names() -> list[str]:
    return [function.name for function in functions(RemoteSim)]


def _constants() -> Iterator[tuple[str, int]]:
    for name in dir(RemoteSim):
        value = getattr(RemoteSim, name)
        if not name.startswith("_") and isinstance(value, int):
            yield name, value


def _argument(client: RemoteClient, value: Any, depth: int = 0) -> Any:
    """Return an argument with the client's functions, down to the second level, as callables."""
    if isinstance(value, str):
        if protocol.is_nil(value):
            return None
        name = protocol.callback_name(value)
        return value if name is None else RemoteCallback(client, name)
    if depth == 0 and isinstance(value, list):
        return [_argument(client, each, 1) for each in value] if any(isinstance(e, str) for e in value) else value
    if depth == 0 and isinstance(value, dict):
        return {key: _argument(client, each, 1) for key, each in value.items()}
    return value
