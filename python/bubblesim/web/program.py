# SPDX-License-Identifier: BSD-3-Clause
"""The program of the server."""

from __future__ import annotations

import argparse
import asyncio
import errno
import getpass
import os
import shlex
import signal
import socket
import sys
import webbrowser
from collections.abc import Callable
from pathlib import Path

from aiohttp import web

from bubblesim.program.addresses import is_loopback, user_of_port
from bubblesim.program.output import write_line
from bubblesim.running.places import page_folder
from bubblesim.web.access import Access
from bubblesim.web.address_file import write_address
from bubblesim.web.bag_recording import recording
from bubblesim.web.connections import ACCEPTED_AT_ONCE, MOST_WAITING, Connection, Connections
from bubblesim.web.hub import Hub
from bubblesim.web.log_limit import limit_log
from bubblesim.web.page import serve_page

PORT = 8080
TOKEN = "BUBBLESIM_WEB_TOKEN"  # variable of the environment: other users see command lines
_TRIES = 20  # ports, when none was asked for
_LONGEST_END = 5  # s for the end, however long a call of another program takes


def main() -> int:
    """Serve until SIGINT or SIGTERM, or until the program that has started this ends."""
    parser = argparse.ArgumentParser(prog="bubblesim view", description=__doc__, allow_abbrev=False)
    add_arguments(parser)
    return serve(parser.parse_args())


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the server."""
    parser.add_argument(
        "--remote",
        metavar="PORT_OR_PATH",
        default="23000",
        help="port of the node's --remote on this machine (default 23000), or path of its socket",
    )
    parser.add_argument("--remote-token", metavar="FILE", help="token of a node that runs with --remote-token=FILE")
    parser.add_argument("--port", type=int, help=f"port of the page (default: {PORT}, or the next free one)")
    parser.add_argument(
        "--address",
        default="127.0.0.1",
        help="address to listen on (default 127.0.0.1); with another one, all who reach it and have the token can run "
        "programs as you, over a connection that is not encrypted",
    )
    parser.add_argument(
        "--read-only",
        action="store_true",
        help="pages are read-only: no scripts, files or programs",
    )
    parser.add_argument("--until-closed", metavar="DESCRIPTOR", type=int, help=argparse.SUPPRESS)
    parser.add_argument("--browser", action="store_true", help="open the page in a browser, if there is a display")


def serve(options: argparse.Namespace) -> int:
    """Run the server with the given arguments."""
    folder = page_folder()
    limit_log()
    if options.until_closed is None:
        _warn_without_simulator(options.remote)
    asyncio.run(_serve(options, folder))
    return 0


def _warn_without_simulator(place: str) -> None:
    """Report that no simulator listens on a port of this machine, or on the path of a socket; the window waits."""
    try:
        if place.isdigit():
            socket.create_connection(("127.0.0.1", int(place)), 1.0).close()
        else:
            with socket.socket(socket.AF_UNIX) as probe:
                probe.connect(place)
    except (OSError, OverflowError):
        where = f"port {place}" if place.isdigit() else place
        start = "bubblesim run SCENE --remote" + (f"={place}" if place.isdigit() and place != "23000" else "")
        write_line(
            sys.stderr, f"warning: no simulator listens on {where}: the window waits for one; to start one: {start}"
        )


async def _serve(options: argparse.Namespace, folder: Path) -> None:
    ending = asyncio.Event()
    loop = asyncio.get_running_loop()
    for number in (signal.SIGINT, signal.SIGTERM):
        loop.add_signal_handler(number, ending.set)
    if options.until_closed is not None:  # by the end of the program that has started this
        loop.add_reader(options.until_closed, ending.set)
    hub = Hub(_node_address(options.remote), Path(options.remote_token) if options.remote_token else None)
    application = web.Application()
    runner = web.AppRunner(application, access_log=None, keepalive_timeout=5.0)
    connections = Connections()
    access = Access(options.address, connections, os.environ.pop(TOKEN, ""))
    application.middlewares.append(access.middleware)

    async def index(_request: web.Request) -> web.StreamResponse:
        return web.FileResponse(folder / "index.html")

    async def page(request: web.Request) -> web.StreamResponse:
        return await serve_page(request, access, hub, may_edit=not options.read_only)

    application.router.add_get("/", index)
    application.router.add_get("/socket", page)
    application.router.add_static("/", folder)
    await runner.setup()
    first = PORT if options.port is None else options.port
    # The window of a node that runs takes the next port; for a user who asked for one here, this is an error.
    tries = 1 if options.port is not None and options.until_closed is None else _TRIES
    ports = list(range(first, first + tries))
    try:
        assert runner.server is not None
        make_protocol = runner.server
        listening, port = await _listen(lambda: Connection(connections, make_protocol()), options.address, ports)
    except OSError as error:
        await runner.cleanup()
        raise SystemExit(
            f"error: the window cannot listen on {options.address}:{ports[0]}: {_reason(error, ports[0])}; "
            f"another port: {'--port PORT' if options.until_closed is None else '--web=PORT'}"
        ) from None
    if options.port is not None and port != options.port:
        write_line(
            sys.stderr, f"warning: port {options.port} is in use{user_of_port(options.port)}: the window takes {port}"
        )
    access.port = port
    following = asyncio.create_task(hub.run())
    file = _show_address(options, access)
    await ending.wait()
    signal.alarm(_LONGEST_END)
    if file is not None:
        file.unlink(missing_ok=True)  # while the port is ours: after that it may be that of another server
    recording.close()
    following.cancel()
    await asyncio.wait([following])
    listening.close()
    await runner.server.shutdown(1.0)
    await runner.cleanup()
    await hub.close()


def _reason(error: OSError, port: int) -> str:
    # asyncio's strerror repeats the address, and is in lower case.
    return os.strerror(error.errno or 0) + (user_of_port(port) if error.errno == errno.EADDRINUSE else "")


def _show_address(options: argparse.Namespace, access: Access) -> Path | None:
    """Print the address, and write it to a file, which is returned. A log gets it without the token."""
    file = None
    shown = access.whole_address
    try:
        file = write_address(access.whole_address, access.port)
    except OSError as error:
        write_line(sys.stderr, f"warning: the address of the window cannot be written to a file: {error}")
        hint = f"and needs the token that {TOKEN} gives to the node"
    else:
        hint = f"and needs a token: xdg-open {shlex.quote(str(file))}"
    if not sys.stderr.isatty():
        shown = f"{access.public_address} {hint}"
    write_line(sys.stderr, f"info: the window is at {shown}")
    if is_loopback(options.address) and (tunnel := _tunnel(access.port)):
        write_line(sys.stderr, f"info: on your own machine, before you open it: {tunnel}")
    if not is_loopback(options.address):
        write_line(sys.stderr, f"warning: all who reach {options.address} and have the token can use the window")
    if options.browser and os.environ.get("DISPLAY") and file is not None:
        webbrowser.open(file.as_uri())  # the command line of a browser does not show the token
    return file


def _tunnel(port: int) -> str:
    """Return the command by which a user who came over ssh reaches a port here; empty for others."""
    connection = os.environ.get("SSH_CONNECTION", "").split()  # the client's address and port, the server's
    return f"ssh -L {port}:127.0.0.1:{port} {getpass.getuser()}@{connection[2]}" if len(connection) == 4 else ""


def _node_address(place: str) -> str:
    """Return the ZeroMQ address of a port of this machine, or of the path of a socket."""
    return f"tcp://127.0.0.1:{place}" if place.isdigit() else f"ipc://{Path(place).absolute()}"


async def _listen(
    make_protocol: Callable[[], asyncio.Protocol], address: str, ports: list[int]
) -> tuple[asyncio.Server, int]:
    """Listen on the first port that is free, and return it.

    :raises OSError: if there is none.
    """
    loop = asyncio.get_running_loop()
    for port in ports:
        try:  # not after a look at which one is free: other servers look at the same time
            server = await loop.create_server(make_protocol, address, port, backlog=ACCEPTED_AT_ONCE)
        except OSError as error:
            if error.errno != errno.EADDRINUSE or port == ports[-1]:
                raise
        else:
            for each in server.sockets:
                with each.dup() as listening:
                    listening.listen(MOST_WAITING)  # asyncio has one number for this and for what it accepts at once
            return server, port
    raise ValueError("no ports are given")
