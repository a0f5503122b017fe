# SPDX-License-Identifier: BSD-3-Clause
"""Calls of the ROS master and of nodes by XML-RPC, without waiting for ever.

The functions are those of https://wiki.ros.org/ROS/Master_API and https://wiki.ros.org/ROS/Slave_API.
"""

from __future__ import annotations

import http.client
import xmlrpc.client
from typing import Any

_TIMEOUT = 5.0  # s, also for a busy machine
_SUCCESS = 1


class RosCallError(RuntimeError):
    """A master or a node that does not answer as one; the cause is the reason."""


class FailedRosCallError(RosCallError):
    """An answer that a call has failed, for instance because there is no such node, service or parameter."""


def call(uri: str, caller: str, function: str, *arguments: object) -> Any:
    """Call a function of the master or of a node at ``uri`` and return its value.

    :param caller: name of a node, which the other side may log.
    :raises RosCallError: if there is no answer in 5 s, or not one of ROS.
    :raises FailedRosCallError: if the answer is that it failed.
    """
    try:
        with xmlrpc.client.ServerProxy(uri, transport=_Transport()) as server:
            answer: Any = getattr(server, function)(caller, *arguments)
        code, message, value = answer
    except (OSError, xmlrpc.client.Error, http.client.HTTPException, TypeError, ValueError) as error:
        raise RosCallError(f"{uri} does not answer {function}: {error}") from error
    if code != _SUCCESS:
        raise FailedRosCallError(f"{function} failed: {message}")
    return value


class _Transport(xmlrpc.client.Transport):
    def make_connection(self, host: Any) -> http.client.HTTPConnection:
        connection = super().make_connection(host)
        connection.timeout = _TIMEOUT
        return connection
