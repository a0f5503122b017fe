# SPDX-License-Identifier: BSD-3-Clause
"""The server of the window, perhaps without a simulator, and its clients without a browser."""

import asyncio
import http.client
import os
import re
import socket
from collections.abc import AsyncIterator, Mapping
from contextlib import asynccontextmanager
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import aiohttp
import cbor2

from process_support import open_files
from ros_support import DEADLINE, free_port, start, stop, stopped_on_failure, wait_until
from web_support import TIMEOUT, TOKEN


class Server:
    """The server of the window; it ends with the block. It expects a simulator at `remote_port`."""

    def __init__(self, folder: Path, *options: str, env: Mapping[str, str] | None = None) -> None:
        """Start it, with the token t unless the environment is given."""
        self.remote_port, self.port = free_port(), free_port()
        self._log = folder / "server.txt"
        command = ["bubblesim", "view", "--remote", str(self.remote_port), "--port", str(self.port), *options]
        with self._log.open("w") as output:
            self.process = start(command, env or os.environ | TOKEN, cwd=folder, stdout=output, stderr=output)
        self.origin = f"http://127.0.0.1:{self.port}"
        with stopped_on_failure(self.process):
            wait_until(lambda: "the window is at" in self.output, "the server", timeout=TIMEOUT / 1000)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        stop(self.process)

    @property
    def output(self) -> str:
        """What it has printed."""
        return self._log.read_text()

    @property
    def address(self) -> str:
        """The whole address."""
        return f"{self.origin}/#token=t"

    @property
    def address_file(self) -> Path:
        """The file with the whole address."""
        found = re.search(r"xdg-open (\S+)", self.output)
        assert found, self.output
        return Path(found[1])

    def descriptors(self) -> int:
        """Return how many descriptors are open."""
        return open_files(self.process.pid)

    def connect(self) -> socket.socket:
        """Open a connection, and send nothing."""
        return socket.create_connection(("127.0.0.1", self.port), timeout=TIMEOUT / 1000)

    def get(self, path: str, **headers: str) -> tuple[int, dict[str, str]]:
        """Return status and headers of the answer to a request."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=DEADLINE)
        connection.putrequest("GET", path, skip_host=True)
        own = {"Host": f"127.0.0.1:{self.port}"}
        for name, value in (own | {name.replace("_", "-"): value for name, value in headers.items()}).items():
            connection.putheader(name, value)
        connection.endheaders()
        answer = connection.getresponse()
        connection.close()
        return answer.status, dict(answer.getheaders())


def is_closed(connection: socket.socket) -> bool:
    """Return whether the peer has closed a connection; all that it has sent is dropped."""
    connection.setblocking(False)
    try:
        while connection.recv(65536):
            pass
    except BlockingIOError:
        return False
    except ConnectionError:
        pass
    return True


class PageClient:
    """A page without a browser."""

    def __init__(self, socket: aiohttp.ClientWebSocketResponse) -> None:
        """Begin after the token."""
        self.socket = socket
        self._next = 0

    async def send(self, function: str, *arguments: Any, line: str = "") -> int:
        """Call a function; return the number of the call."""
        self._next += 1
        await self.socket.send_bytes(cbor2.dumps([self._next, function, list(arguments), line]))
        return self._next

    async def next_reply(self) -> tuple[int, dict[str, Any]]:
        """Return number and reply of the next call that is answered."""
        while True:
            data = await asyncio.wait_for(self.socket.receive_bytes(), TIMEOUT / 1000)
            if data[0] == 0:  # a frame
                continue
            message = cbor2.loads(data)
            if message[0] is not None:
                return message[0], message[1]

    async def wait_for_event(self, name: str) -> Any:
        """Return the data of the next event of a name."""
        while True:
            data = await asyncio.wait_for(self.socket.receive_bytes(), TIMEOUT / 1000)
            if data[0] != 0 and (message := cbor2.loads(data))[:2] == [None, name]:
                return message[2]

    async def call(self, function: str, *arguments: Any) -> Any:
        """Call a function and return its result; raise its error as RuntimeError."""
        number = await self.send(function, *arguments)
        while True:
            answered, reply = await self.next_reply()
            if answered == number:
                if "err" in reply:
                    raise RuntimeError(reply["err"])
                return reply["ret"][0]


@asynccontextmanager
async def websocket(origin: str) -> AsyncIterator[aiohttp.ClientWebSocketResponse]:
    """Open the socket of a page, before its token."""
    async with (
        aiohttp.ClientSession() as session,
        session.ws_connect(f"{origin}/socket", headers={"Origin": origin}, max_msg_size=0) as opened,
    ):
        yield opened


@asynccontextmanager
async def page_client(origin: str, token: str = "t") -> AsyncIterator[PageClient]:
    """Open a page."""
    async with websocket(origin) as opened:
        await opened.send_str(token)
        yield PageClient(opened)
