# SPDX-License-Identifier: BSD-3-Clause
"""What connections without the token can take from the server of the window."""

import asyncio
import socket
import time
from collections.abc import Iterator
from contextlib import ExitStack, closing, suppress
from http.client import HTTPConnection
from pathlib import Path

import pytest

from page_client import Server, is_closed, page_client
from ros_support import wait_until
from rude_client import junk_sent_to


@pytest.fixture
def server(tmp_path: Path) -> Iterator[Server]:
    with Server(tmp_path) as running:
        yield running


@pytest.mark.parametrize("part", [b"", b"GET / HT", b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nX-Slow: "])
def test_a_connection_without_a_whole_request_ends_soon(server: Server, part: bytes) -> None:
    with server.connect() as connection:
        begin = time.monotonic()
        connection.sendall(part)
        wait_until(lambda: is_closed(connection), "the end of the connection")
        assert 3 < time.monotonic() - begin < 15


def test_an_idle_connection_ends_after_its_request(server: Server) -> None:
    with server.connect() as connection:
        connection.sendall(f"GET /icon.svg HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\n\r\nGET / HT".encode())
        assert b"200 OK" in connection.recv(65536)
        wait_until(lambda: is_closed(connection), "the end of the connection")


def test_a_connection_with_a_request_is_kept_before_those_without(server: Server) -> None:
    with closing(HTTPConnection("127.0.0.1", server.port, timeout=10)) as first, ExitStack() as ends:

        def ask() -> None:
            first.request("GET", "/icon.svg")
            answer = first.getresponse()
            assert answer.status == 200
            answer.read()

        ask()
        others = []
        for _ in range(15):
            for _ in range(10):  # less than wait for accept()
                others.append(ends.enter_context(server.connect()))
                others[-1].sendall(b"GET / HT")
            ask()  # so that it is never idle
        wait_until(lambda: is_closed(others[0]), "the oldest without a request to make room")
        ask()


def test_requests_are_answered_while_others_send_junk(server: Server) -> None:
    def ask() -> bytes:
        with server.connect() as connection:  # less work than an HTTPConnection: more of them at once
            connection.sendall(f"GET /icon.svg HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\n\r\n".encode())
            return connection.recv(15)

    with ExitStack() as ends:
        for _ in range(4):
            ends.enter_context(junk_sent_to(server.port))
        answers = {ask() for _ in range(2000)}
    assert answers == {b"HTTP/1.1 200 OK"}


def test_a_thousand_connections_leave_room_for_pages(server: Server) -> None:
    before = server.descriptors()

    async def crowd() -> int:
        async with page_client(server.origin) as old:
            await old.wait_for_event("hello")
            with ExitStack() as ends:
                for _ in range(1100):
                    ends.enter_context(server.connect()).sendall(b"GET / HT")
                most = server.descriptors()
                assert server.get("/")[0] == 200
                async with page_client(server.origin) as new:
                    await new.wait_for_event("hello")
                    for page in (old, new):
                        assert await page.call("server.recording") == {"runs": False, "file": ""}
                return most

    at_once = 4 * 8  # those that are accepted in a turn of the server's loop, and those that are being closed
    two_pages = 2 * 17
    assert asyncio.run(crowd()) - before < 120 + at_once + two_pages
    assert len(server.output.splitlines()) < 5


def test_pages_beyond_the_limit_are_refused_with_a_reason(server: Server) -> None:
    async def last() -> object:
        async with asyncio.TaskGroup() as tasks:
            done = asyncio.Event()

            async def hold() -> None:
                async with page_client(server.origin) as page:
                    await page.wait_for_event("hello")
                    opened.release()
                    await done.wait()

            opened = asyncio.Semaphore(0)
            for _ in range(40):
                tasks.create_task(hold())
            for _ in range(40):
                await opened.acquire()
            async with page_client(server.origin) as page:
                message = await page.socket.receive(20)
            done.set()
            return message.data, message.extra

    code, reason = asyncio.run(last())  # type: ignore[misc]
    assert code == 1013
    assert "Too many pages" in reason


def test_who_has_no_token_cannot_send_much(server: Server) -> None:
    with server.connect() as connection:
        head = f"GET / HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\nContent-Length: 100000000\r\n\r\n"
        connection.sendall(head.encode())
        with pytest.raises(ConnectionError):
            connection.sendall(bytes(100_000_000))


def test_bad_requests_fill_no_log(server: Server) -> None:
    for _ in range(200):
        with server.connect() as connection:
            connection.sendall(b"\x00\x01\r\n\r\n")
            connection.shutdown(socket.SHUT_WR)
            connection.recv(1000)
    assert server.get("/")[0] == 200
    reported = server.output.count("Error handling request")
    assert reported <= 10
    assert ("left out for one minute" in server.output) == (reported > 0)  # aiohttp 3.11 reports none of them


@pytest.mark.long
def test_a_connection_without_the_token_ends_after_a_minute(server: Server) -> None:
    begin = time.monotonic()
    with server.connect() as connection:
        connection.sendall(f"GET / HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\n\r\n".encode())
        while not is_closed(connection):  # one that goes on asking
            assert time.monotonic() - begin < 70
            time.sleep(3.0)
            with suppress(OSError):
                connection.setblocking(True)
                connection.sendall(f"GET /icon.svg HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\n\r\n".encode())
    assert time.monotonic() - begin > 50
