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
from bubblesim.scripting.api.ik.ik_module import SimIk
from bubblesim.scripting.api.old_names import names_to
from bubblesim.scripting.api.ompl.ompl_module import SimOmpl
from bubblesim.scripting.api.ui.ui_module import SimUi

MODULES_OF_CLIENTS: dict[str, type] = {"sim": RemoteSim, "simUI": SimUi, "simIK": SimIk, "simOMPL": SimOmpl}


def carry_out(request: protocol.Request, sim: RemoteSim, client: RemoteClient) -> Any:
    """Call the function and return its result, which may be a Pending or a Conversation.

    :raises Exception: what the function raises, or that there is no such function.
    """
    module, _, name = request.function.partition(".")
    module = _without_version(module)
    if module == "zmqRemoteApi" and name in ("require", "info"):
        wanted = request.arguments[0] if request.arguments else ""
        bare = _without_version(wanted) if isinstance(wanted, str) else ""
        if bare not in MODULES_OF_CLIENTS:
            raise ImportError(f"module '{wanted}' not found: remote clients have {', '.join(MODULES_OF_CLIENTS)}")
        return None if name == "require" else info(bare)
    if request.function == "frames.open":
        return client.server.publish_frames()
    if request.function == "frames.layout":
        return layout(client)
    if module == "window":
        return window_functions.call(client.server.host, client, name, request.arguments)
    if module not in MODULES_OF_CLIENTS or name.startswith("_"):
        known = ", ".join(MODULES_OF_CLIENTS)
        raise AttributeError(f"there is no function '{request.function}': remote clients have those of {known}")
    function = getattr(sim if module == "sim" else sim.other_module(module), name)
    if not callable(function):
        raise TypeError(f"{module}.{name} is a constant, not a function")
    arguments = [_argument(client, value) for value in request.arguments]
    while arguments and arguments[-1] is None:  # a trailing nil is an omitted argument
        arguments.pop()
    return function(*arguments)


def info(module: str = "sim") -> dict[str, dict[str, Any]]:
    """Return the functions and constants of a module as clients ask for them, also under their old names."""
    type_of_module = MODULES_OF_CLIENTS[module]
    names = [function.name for function in functions(type_of_module)]
    old = names_to(module, lambda _, name: name in names)
    return {
        **{name: {"func": {}} for name in (*names, *old)},
        **dict(_constants(type_of_module)),
    }


def _without_version(module: str) -> str:
    """Return the name of a module: 'sim' for 'sim-2'."""
    return module.partition("-")[0]


def _constants(module: type) -> Iterator[tuple[str, dict[str, Any]]]:
    for name in dir(module):
        value = getattr(module, name)
        if name.startswith("_"):
            continue
        if isinstance(value, int):
            yield name, {"const": value}
        elif isinstance(value, dict):  # constants in a group
            yield name, {each: {"const": number} for each, number in value.items()}


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
