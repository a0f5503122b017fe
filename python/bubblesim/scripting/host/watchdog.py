# SPDX-License-Identifier: BSD-3-Clause
"""Notices a callback that does not return, while the simulation waits for it, and breaks it off for a stop."""

from __future__ import annotations

import sys
import threading
import weakref

from bubblesim.output import write_line
from bubblesim.scripting.host import interruption
from bubblesim.scripting.host.protocols import Host, RunningScript

_BETWEEN_LOOKS = 0.5  # s
_LOOKS = 3  # at which the same call is found, before it is told


def start(host: Host) -> None:
    """Look from now on, from a thread that ends with the host."""
    arguments = weakref.ref(host), threading.get_ident()
    threading.Thread(target=_watch, args=arguments, name="watchdog of scripts", daemon=True).start()


def _watch(find_host: weakref.ref[Host], simulation_thread: int) -> None:
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
        if script is not None and looks >= _LOOKS:
            script.stuck_at = script.where_now(simulation_thread)
            if looks == _LOOKS:
                _warn(script)
            if host.stop_waits():
                _break_off(host, call, simulation_thread)
        del host, script


def _break_off(host: Host, call: int, simulation_thread: int) -> None:
    interruption.break_off(simulation_thread, lambda: host.running_script is not None and host.calls == call)


def _warn(script: RunningScript) -> None:
    place = f", now at {script.stuck_at}" if script.stuck_at else ""
    write_line(
        sys.stderr,
        f"warning: child script of {script.object_path} has not returned from {script.doing} for "
        f"{_LOOKS * _BETWEEN_LOOKS:g} s{place}: the simulation waits for it",
    )
