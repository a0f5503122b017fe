# SPDX-License-Identifier: BSD-3-Clause
"""The functions of the module ``window``: each takes the Window and the arguments of the client."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from bubblesim.remote.window import building, editing, objects, panels, running, saving, scene, sensors
from bubblesim.remote.window.window import WindowClient, window_of


def by_name(subjects: Iterable[Any]) -> dict[str, Callable[..., Any]]:
    """Return the FUNCTIONS of some modules by their names.

    :raises TypeError: if two of them have one name.
    """
    functions: dict[str, Callable[..., Any]] = {}
    for function in (each for subject in subjects for each in subject.FUNCTIONS):
        other = functions.setdefault(function.__name__, function)
        if other is not function:
            raise TypeError(f"two functions 'window.{function.__name__}': in {other.__module__}, {function.__module__}")
    return functions


# A file for each subject; its FUNCTIONS are what clients may call.
FUNCTIONS = by_name((scene, running, sensors, objects, editing, building, saving, panels))


def call(host: Any, client: WindowClient, name: str, arguments: list[Any]) -> Any:
    """Call a function of the window for a client, in the scene of a ScriptHost.

    :raises AttributeError: if there is no function of that name.
    """
    function = FUNCTIONS.get(name)
    if function is None:
        raise AttributeError(f"there is no function 'window.{name}'")
    window = window_of(host)
    window.client = client
    return function(window, *arguments)
