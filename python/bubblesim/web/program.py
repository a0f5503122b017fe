# SPDX-License-Identifier: BSD-3-Clause
"""The program of the server."""

from __future__ import annotations

import argparse
import asyncio
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
    parser.add_argument("--door", metavar="PORT", type=int, default=23000, help="port of the node's --remote")
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
    hub = Hub(f"tcp://127.0.0.1:{options.door}")
    application = web.Application()
    runner = web.AppRunner(application, access_log=None)
    port = options.port if options.port is not None else _free_port(options.address)
    access = Access(options.address, port, token=options.token)
    application.middlewares.append(access.middleware)

    async def index(_request: web.Request) -> web.StreamResponse:
        return web.FileResponse(folder / "index.html")

    async def page(request: web.Request) -> web.StreamResponse:
        return await Page(hub, may_edit=not options.look).serve(request)

    application.router.add_get("/", index)
    application.router.add_get("/socket", page)
    application.router.add_static("/", folder)
    await runner.setup()
    try:
        await web.TCPSite(runner, options.address, port, shutdown_timeout=1.0).start()
    except OSError as error:
        await runner.cleanup()
        raise SystemExit(
            f"error: the window cannot listen on {options.address}:{port}: {error.strerror}; another port: --web=PORT"
        ) from None
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


def _free_port(address: str) -> int:
    import socket

    for port in range(PORT, PORT + _TRIES):
        with socket.socket() as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                probe.bind((address, port))
            except OSError:
                continue
            return port
    return PORT
