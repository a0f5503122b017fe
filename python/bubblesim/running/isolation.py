# SPDX-License-Identifier: BSD-3-Clause
"""A ROS master and a ROS 2 domain of a run's own, so that several runs and users share a machine."""

from __future__ import annotations

import os
import random
import socket
from collections.abc import MutableMapping

from bubblesim.running.processes import RunError

_FIRST_PORT = 11400
_DOMAINS = 101  # of ROS 2: above, its ports are those of outgoing connections on Linux
_ALL_IN_USE = (
    f"the ROS domains 1 to {_DOMAINS} and their ports from {_FIRST_PORT + 1} are all in use: `bubblesim ps` lists runs"
)


def isolate(environment: MutableMapping[str, str] = os.environ) -> str:
    """Set ROS_MASTER_URI and ROS_DOMAIN_ID to those of a new number N; return the command that sets them elsewhere.

    The master has port 11400 + N, the domain is N. Nobody else on this machine gets the number until this process has
    ended, also if it becomes another program (exec). A master of another machine is left.

    :raises RunError: if no number is free.
    """
    number, holder = reserve_domain()
    holder.set_inheritable(True)
    holder.detach()  # the end of the process closes it
    values = {
        "ROS_MASTER_URI": f"http://localhost:{_FIRST_PORT + number}",
        "ROS_HOSTNAME": "localhost",
        "ROS_DOMAIN_ID": str(number),
    }
    environment.update(values)
    return "export " + " ".join(f"{name}={value}" for name, value in values.items())


def reserve_domain() -> tuple[int, socket.socket]:
    """Return a ROS_DOMAIN_ID that nobody else gets, here or from ``isolate``, until the socket is closed.

    :raises RunError: if no number is free.
    """
    for number in _numbers():
        holder = socket.socket(socket.AF_UNIX)
        try:
            holder.bind(f"\0bubblesim_domain_{number}")  # an abstract name, which ends with its last descriptor
        except OSError:
            holder.close()
            continue
        if _is_free(_FIRST_PORT + number):
            return number, holder
        holder.close()
    raise RunError(_ALL_IN_USE)


def _numbers() -> list[int]:
    numbers = list(range(1, _DOMAINS + 1))
    random.shuffle(numbers)  # many users start at once
    return numbers


def _is_free(port: int) -> bool:
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind(("127.0.0.1", port))
        except OSError:
            return False
    return True
