# SPDX-License-Identifier: BSD-3-Clause
"""Who may use the server, and for what."""

from __future__ import annotations

import re
import secrets
from collections.abc import Awaitable, Callable
from urllib.parse import urlsplit

from aiohttp import web

from bubblesim.addresses import is_loopback

_LOOKING = re.compile(r"sim\.(get|read|is|check)[A-Z]\w*|window\.(share|events|models|mesh|texture|get\w+|read\w*)")
_NOT_LOOKING = {"sim.getRandom"}  # draws from the scene's random numbers
_NO_TOKEN = """\
<!doctype html><title>bubblesim</title><body style="font: 16px sans-serif; max-width: 40em; margin: 4em auto">
<h1>This address needs a token</h1>
<p>Open the whole address that the simulator has printed: it ends in <code>?token=...</code> and is printed again by
<code>bubblesim view</code>.</p>
"""
_HEADERS = {
    "Content-Security-Policy": "default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' blob: data:; "
    "frame-ancestors 'none'; base-uri 'none'; form-action 'none'",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cache-Control": "no-cache",
}

Handler = Callable[[web.Request], Awaitable[web.StreamResponse]]


def is_looking(function: str) -> bool:
    """Return whether a function of the door changes nothing."""
    return bool(_LOOKING.fullmatch(function)) and function not in _NOT_LOOKING


class Access:
    """Lets in who has the token, with requests that are meant for this server."""

    def __init__(self, address: str, *, token: str | None = None) -> None:
        """Make a token, unless one is given. Nobody is let in before the ``port`` is known.

        :param address: on which the server listens.
        """
        self.token = token or secrets.token_urlsafe(24)
        self.port = 0
        self._names = {"127.0.0.1", "localhost", "::1"}
        self._any_host = not is_loopback(address)  # it is reached under names that are not known here

    @web.middleware
    async def middleware(self, request: web.Request, handler: Handler) -> web.StreamResponse:
        """Answer a request, or refuse it."""
        if not self._is_meant_for_us(request):
            raise web.HTTPForbidden(text="the Host or Origin of this request is not that of this server")
        if secrets.compare_digest(request.query.get("token", "").encode(), self.token.encode()):
            response: web.StreamResponse = web.HTTPFound(request.path)  # the token does not stay in the address line
            response.set_cookie(self._cookie(), self.token, httponly=True, samesite="Strict")
            return response
        if not secrets.compare_digest(request.cookies.get(self._cookie(), "").encode(), self.token.encode()):
            return web.Response(status=403, text=_NO_TOKEN, content_type="text/html")
        response = await handler(request)
        if not response.prepared:
            response.headers.update(_HEADERS)
        return response

    def _cookie(self) -> str:
        return f"bubblesim-{self.port}"

    def _is_meant_for_us(self, request: web.Request) -> bool:
        """Return whether neither another site nor a name that someone else has given to this address is in play."""
        host = urlsplit(f"//{request.headers.get('Host', '')}")
        try:
            known = host.port == self.port and (self._any_host or host.hostname in self._names)
        except ValueError:
            return False
        origin = request.headers.get("Origin")
        if request.headers.get("Upgrade", "").lower() == "websocket" and origin is None:
            return False
        return known and (origin is None or origin == f"http://{request.headers['Host']}")
