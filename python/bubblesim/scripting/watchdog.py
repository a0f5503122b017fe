# SPDX-License-Identifier: BSD-3-Clause
"""Notices a callback that does not return, while the simulation waits for it."""

from __future__ import annotations

import sys
import threading
import weakref
from typing import TYPE_CHECKING

from bubblesim.scripting.output import write_line

if TYPE_CHECKING:
    from bubblesim.scripting.host import ScriptHost

_BETWEEN_LOOKS = 0.5  # s
_LOOKS = 3  # at which the same call is found, before it is told


def start(host: ScriptHost) -> None:
    """Look from now on, from a thread that ends with the host."""
    arguments = weakref.ref(host), threading.get_ident()
    threading.Thread(target=_watch, args=arguments, name="watchdog of scripts", daemon=True).start()


def _watch(find_host: weakref.ref[ScriptHost], simulation_thread: int) -> None:
    wait = threading.Event().wait
    last_call, looks = -1, 0
    while True:
        wait(_BETWEEN_LOOKS)
        host = find_host()
        if host is None:
            return
        script = host.running_script
        call = host.calls
        looks = looks + 1 if script is not None and call == last_call else 0
        last_call = call
        if script is not None and looks == _LOOKS:
            place = script.where_now(simulation_thread)
            write_line(
                sys.stderr,
                f"warning: child script of {script.object_path} has not returned from {script.doing} for "
                f"{_LOOKS * _BETWEEN_LOOKS:g} s{f', now at {place}' if place else ''}: the simulation waits for it",
            )
        del host, script
