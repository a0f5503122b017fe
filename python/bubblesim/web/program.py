# SPDX-License-Identifier: BSD-3-Clause
"""The program of the server."""

from __future__ import annotations

import argparse
import asyncio
import errno
import os
import signal
import sys
import webbrowser
from pathlib import Path

from aiohttp import web

from bubblesim.addresses import is_loopback
from bubblesim.output import write_line
from bubblesim.running.places import page_folder
from bubblesim.web.access import Access
from bubblesim.web.bag_recording import recording
from bubblesim.web.hub import Hub
from bubblesim.web.page import Page

PORT = 8080
_TRIES = 20  # ports, when none was asked for


def main() -> int:
    """Serve until SIGINT or SIGTERM, or until the program that has started this ends."""
    parser = argparse.ArgumentParser(prog="bubblesim view", description=__doc__, allow_abbrev=False)
    add_arguments(parser)
    return serve(parser.parse_args())


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the server."""
    parser.add_argument(
        "--door",
        metavar="PORT_OR_PATH",
        default="23000",
        help="port of the node's --remote on this machine (default 23000), or path of its socket",
    )
    parser.add_argument("--port", type=int, help=f"port of the page (default: {PORT}, or the next free one)")
    parser.add_argument(
        "--address",
        default="127.0.0.1",
        help="address to listen on (default 127.0.0.1); with another one, all who reach it and have the token control "
        "the simulation, over a connection that is not encrypted",
    )
    parser.add_argument("--look", action="store_true", help="pages may look, and change nothing")
    parser.add_argument("--token", help="the token of the address (default: a new one)")
    parser.add_argument("--until-closed", metavar="DESCRIPTOR", type=int, help=argparse.SUPPRESS)
    parser.add_argument("--browser", action="store_true", help="open the page in a browser, if there is a display")


def serve(options: argparse.Namespace) -> int:
    """Run the server with the given arguments."""
    folder = page_folder()
    asyncio.run(_serve(options, folder))
    return 0


async def _serve(options: argparse.Namespace, folder: Path) -> None:
    ending = asyncio.Event()
    loop = asyncio.get_running_loop()
    for number in (signal.SIGINT, signal.SIGTERM):
        loop.add_signal_handler(number, ending.set)
    if options.until_closed is not None:  # by the end of the program that has started this
        loop.add_reader(options.until_closed, ending.set)
    hub = Hub(_door_address(options.door))
    application = web.Application()
    runner = web.AppRunner(application, access_log=None)
    access = Access(options.address, token=options.token)
    application.middlewares.append(access.middleware)

    async def index(_request: web.Request) -> web.StreamResponse:
        return web.FileResponse(folder / "index.html")

    async def page(request: web.Request) -> web.StreamResponse:
        return await Page(hub, may_edit=not options.look).serve(request)

    application.router.add_get("/", index)
    application.router.add_get("/socket", page)
    application.router.add_static("/", folder)
    await runner.setup()
    ports = [options.port] if options.port is not None else list(range(PORT, PORT + _TRIES))
    try:
        port = await _listen(runner, options.address, ports)
    except OSError as error:
        await runner.cleanup()
        raise SystemExit(
            f"error: the window cannot listen on {options.address}:{ports[0]}: {error.strerror}; "
            "another port: --web=PORT"
        ) from None
    access.port = port
    following = asyncio.create_task(hub.run())
    shown = f"[{options.address}]" if ":" in options.address else options.address
    address = f"http://{shown}:{port}/?token={access.token}"
    write_line(sys.stderr, f"info: the window is at {address}")
    if not is_loopback(options.address):
        write_line(sys.stderr, f"warning: all who reach {options.address} and have this address can use the window")
    if options.browser and os.environ.get("DISPLAY"):
        webbrowser.open(address)
    await ending.wait()
    following.cancel()
    recording.close()
    await runner.cleanup()
    await hub.close()


def _door_address(door: str) -> str:
    """Return the ZeroMQ address of a port of this machine, or of the path of a socket."""
    return f"tcp://127.0.0.1:{door}" if door.isdigit() else f"ipc://{Path(door).absolute()}"


async def _listen(runner: web.AppRunner, address: str, ports: list[int]) -> int:
    """Listen on the first port that is free, and return it.

    :raises OSError: if there is none.
    """
    for port in ports:
        site = web.TCPSite(runner, address, port, shutdown_timeout=1.0)
        try:
            await site.start()  # not after a look at which one is free: other servers look at the same time
            return port
        except OSError as error:
            await site.stop()
            if error.errno != errno.EADDRINUSE or port == ports[-1]:
                raise
    raise ValueError("no ports are given")
