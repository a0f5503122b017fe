# SPDX-License-Identifier: BSD-3-Clause
"""Detects a callback that does not return, warns, and interrupts it for a pending stop."""

from __future__ import annotations

import sys
import threading
import weakref

from bubblesim.program.output import write_line
from bubblesim.scripting.host import interruption
from bubblesim.scripting.host.missing_master import waits_for_master
from bubblesim.scripting.host.protocols import Host, RunningScript

_CHECK_INTERVAL = 0.1  # s
_CHECKS = 15  # number of checks with the same call before the warning


class Watchdog:
    """Watches the scripts of a run, from its start on the simulation's thread to end() or the host's destruction."""

    def __init__(self, host: Host) -> None:
        """Start watching."""
        self._ended = threading.Event()
        arguments = weakref.ref(host), threading.get_ident(), self._ended
        self._thread = threading.Thread(target=_watch, args=arguments, name="watchdog of scripts", daemon=True)
        self._thread.start()

    def end(self) -> None:
        """Return when nothing of the host is in use: its thread must not be the last one that does."""
        self._ended.set()
        self._thread.join()


def _watch(find_host: weakref.ref[Host], simulation_thread: int, ended: threading.Event) -> None:
    last_call, checks = -1, 0
    while not ended.wait(_CHECK_INTERVAL):
        host = find_host()
        if host is None:
            return
        script = host.running_script
        call = host.calls
        checks = checks + 1 if script is not None and call == last_call else 0
        last_call = call
        if script is not None and checks >= _CHECKS:
            script.stuck_at = script.where_now(simulation_thread)
            if checks == _CHECKS:
                _warn(script, waits_for_master(simulation_thread))
            if host.stop_waits():
                _break_off(host, call, simulation_thread)
        del host, script


def _break_off(host: Host, call: int, simulation_thread: int) -> None:
    interruption.break_off(simulation_thread, lambda: host.running_script is not None and host.calls == call)


def _warn(script: RunningScript, cause: str) -> None:
    place = f", now at {script.stuck_at}" if script.stuck_at else ""
    write_line(
        sys.stderr,
        f"warning: child script of {script.object_path} has not returned from {script.activity} for "
        f"{_CHECKS * _CHECK_INTERVAL:g} s{place}: the simulation is waiting{cause}",
    )
