# SPDX-License-Identifier: BSD-3-Clause
"""Who may use the server, and for what."""

from __future__ import annotations

import asyncio
import re
import secrets
from collections.abc import Awaitable, Callable
from urllib.parse import quote, urlsplit

from aiohttp import WSCloseCode, WSMsgType, web

from bubblesim.program.addresses import is_loopback
from bubblesim.web.connections import Connections

# sim.check... measures, which changes the reading of a sensor and its noise.
_READ_ONLY = re.compile(r"sim\.(get|read|is)[A-Z]\w*|window\.(share|events|models|mesh|texture|get\w+|read\w*)")
_WRITING = {"sim.getRandom"}  # draws from the scene's random numbers
_NO_TOKEN = 4401  # the close code that the page knows
_NEEDS_TOKEN = b"This address needs a token: open the whole address that the simulator has printed"
_TOO_MANY = b"Too many pages show this simulation: close one"
_TIME_FOR_TOKEN = 15.0  # s: a busy page draws first
_HEADERS = {
    "Content-Security-Policy": "default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' blob: data:; "
    "frame-ancestors 'none'; base-uri 'none'; form-action 'none'",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cache-Control": "no-cache",
}

Handler = Callable[[web.Request], Awaitable[web.StreamResponse]]


def is_read_only(function: str) -> bool:
    """Return whether a function of the node changes nothing."""
    return bool(_READ_ONLY.fullmatch(function)) and function not in _WRITING


class Access:
    """Answers requests that are meant for this server, and lets in pages that have the token.

    The files of the page are for all. The token is in the fragment of the address, which browsers do not send: the page
    sends it as the first message of its socket. A cookie would be sent to all servers of this host, on every port.
    """

    def __init__(self, address: str, connections: Connections, token: str = "") -> None:
        """Make a token, unless one is given. No page is let in before the ``port`` is known.

        :param address: on which the server listens.
        """
        self.port = 0
        self._connections = connections
        self._token = token or secrets.token_urlsafe(24)
        self._address = f"[{address}]" if ":" in address else address
        self._names = {"127.0.0.1", "localhost", "::1"}
        self._any_host = not is_loopback(address)  # it is reached under names that are not known here

    @property
    def public_address(self) -> str:
        """The address without the token."""
        return f"http://{self._address}:{self.port}/"

    @property
    def whole_address(self) -> str:
        """The address with the token, for the owner only."""
        return f"{self.public_address}#token={quote(self._token, safe='')}"

    @web.middleware
    async def middleware(self, request: web.Request, handler: Handler) -> web.StreamResponse:
        """Answer a request, or refuse it."""
        self._connections.note_request(request.transport)
        if not self._is_meant_for_us(request):
            raise web.HTTPForbidden(text="the Host or Origin of this request is not that of this server")
        response = await handler(request)
        if not response.prepared:
            response.headers.update(_HEADERS)
        return response

    async def lets_in(self, socket: web.WebSocketResponse, transport: asyncio.BaseTransport | None) -> bool:
        """Return whether the first message is the token; close the socket otherwise."""
        try:
            first = await socket.receive(_TIME_FOR_TOKEN)
            has_token = first.type == WSMsgType.TEXT and self._is_token(first.data)
        except TimeoutError:
            has_token = False
        if not has_token:
            await socket.close(code=_NO_TOKEN, message=_NEEDS_TOKEN)
            return False
        if not self._connections.trust(transport):
            await socket.close(code=WSCloseCode.TRY_AGAIN_LATER, message=_TOO_MANY)
            return False
        return True

    def _is_token(self, text: str) -> bool:
        return secrets.compare_digest(text.encode(), self._token.encode())

    def _is_meant_for_us(self, request: web.Request) -> bool:
        """Return whether neither another site nor a name that someone else has given to this address is in play."""
        try:
            host = urlsplit(f"//{request.headers.get('Host', '')}")
            known = host.port == self.port and (self._any_host or host.hostname in self._names)
        except ValueError:  # it is not a host
            return False
        origin = request.headers.get("Origin")
        if request.headers.get("Upgrade", "").lower() == "websocket" and origin is None:
            return False
        return known and (origin is None or origin == f"http://{request.headers['Host']}")
