# SPDX-License-Identifier: BSD-3-Clause
"""`simROS` functions for services."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from bubblesim import _core
from bubblesim.scripting.api.ros.context import RosContext, with_slashes
from bubblesim.scripting.api.ros.kinds import RosHandle, ServiceOrClient
from bubblesim.scripting.caller import Caller

Request = Mapping[str, Any]
ServiceCallback = Callable[[dict[str, Any]], Request | None] | str

_CALL_TIMEOUT = 10.0  # s


class RosServices(RosContext):
    """Clients and servers of one script; they are shut down when the script ends."""

    def __init__(self, bridge: Any, simulation: Any, caller: Caller) -> None:
        """Bind the functions to one script."""
        super().__init__(bridge, simulation, caller)
        self._clients: dict[int, tuple[str, str]] = {}  # name and request type of the called services

    def call(self, client: RosHandle, request: Request | None = None, timeout: float = _CALL_TIMEOUT) -> dict[str, Any]:
        """Call a service, also one of the same script, and return its response as a dict.

        Raises a RuntimeError if no node offers the service, if it fails, or if it does not respond within ``timeout``
        seconds.
        """
        if client in self._clients and request:
            name, request_type = self._clients[client]
            self._warn_of_truncation(
                f"'{name}'", _core.messages.truncations(request_type, request, self._bridge.version)
            )
        response: dict[str, Any] = self._bridge.call(client, request or {}, timeout, self._time_form)
        return self._byte_arrays.received(client, response)  # type: ignore[no-any-return]

    def waitForService(self, service: ServiceOrClient, timeout: float = _CALL_TIMEOUT) -> bool:
        """Wait for a service (its name, or a client of it) for at most ``timeout`` seconds; return its availability."""
        if isinstance(service, str):
            return bool(self._bridge.wait_for_service(service, timeout))
        if service not in self._clients:
            raise ValueError(f"invalid object handle {service}: no such service client, or it was shut down")
        return bool(self._bridge.wait_for_service(self._clients[service][0], timeout))

    def _client(self, name: str, service_type: str) -> int:
        service_type = with_slashes(service_type)
        client = int(self._bridge.service_client(name, service_type))
        self._clients[client] = name, _core.messages.service_halves(service_type, self._bridge.version)[0]
        self._caller.at_end["client", client] = lambda: self._bridge.shutdown_service_client(client)
        return client

    def _server(self, name: str, service_type: str, callback: ServiceCallback) -> int:
        service_type = with_slashes(service_type)
        version = self._bridge.version
        _, response_type = _core.messages.service_halves(service_type, version)

        def check(response: object) -> None:
            """Report an invalid response as an error of the callback, not of the bridge."""
            if response is not None:
                self._warn_of_truncation(f"'{name}'", _core.messages.truncations(response_type, response, version))

        answer = self._caller.answering_callback(callback, check)

        def deliver(request: dict[str, Any]) -> Any:
            return answer(self._byte_arrays.received(server, request))

        server = int(self._bridge.advertise_service(name, service_type, deliver, self._time_form))
        self._caller.at_end["server", server] = lambda: self._bridge.shutdown_service_server(server)
        return server

    def _shutdown_client(self, client: int) -> None:
        self._bridge.shutdown_service_client(client)
        self._clients.pop(client, None)
        self._byte_arrays.forget(client)
        self._caller.at_end.pop(("client", client), None)

    def _shutdown_server(self, server: int) -> None:
        self._bridge.shutdown_service_server(server)
        self._byte_arrays.forget(server)
        self._caller.at_end.pop(("server", server), None)
