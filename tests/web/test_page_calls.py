# SPDX-License-Identifier: BSD-3-Clause
"""The limits of one page: lines, and calls without an answer."""

import asyncio
from collections.abc import Callable
from pathlib import Path
from typing import Any

from page_client import Server, page_client
from web_support import Node, Window


def test_a_page_has_eight_lines(tmp_path: Path) -> None:
    async def refused(server: Server) -> list[dict[str, Any]]:
        async with page_client(server.origin) as page:
            for number in range(40):  # nobody answers: there is no simulator
                await page.send("sim.getSimulationTime", line=f"line {number}")
            return [(await page.next_reply())[1] for _ in range(32)]

    with Server(tmp_path, "--read-only") as server:
        before = server.descriptors()
        replies = asyncio.run(refused(server))
        assert all("there are 8 already" in reply["err"] for reply in replies)
        assert server.descriptors() - before < 40


def test_a_page_waits_for_few_calls_at_once(tmp_path: Path) -> None:
    async def refused(server: Server) -> list[int]:
        async with page_client(server.origin) as page:
            for _ in range(70):
                await page.send("sim.getSimulationTime")
            replies = [await page.next_reply() for _ in range(6)]
            assert all("waits for the answers of 64 calls" in reply["err"] for _, reply in replies)
            return [number for number, _ in replies]

    with Server(tmp_path) as server:
        assert asyncio.run(refused(server)) == list(range(65, 71))


def test_messages_that_are_no_calls_are_ignored(tmp_path: Path) -> None:
    async def answer(server: Server) -> Any:
        async with page_client(server.origin) as page:
            for message in (b"", b"\xff", b"\x80", b"\x84\x01\x02\x03\x04", b"\x84\xf6\x60\x80\x60", b"\xa0"):
                await page.socket.send_bytes(message)
            await page.socket.send_str("text")
            return await page.call("server.recording")

    with Server(tmp_path) as server:
        assert asyncio.run(answer(server)) == {"runs": False, "file": ""}
        assert "Traceback" not in server.output


def test_the_page_holds_back_what_would_be_too_many_calls(tmp_path: Path, show: Callable[..., Window]) -> None:
    with Node(tmp_path, "ball", "--paused") as node:
        page = show(node)
        calls = "Promise.all(Array.from({ length: 300 }, () => bubblesim.link.call('sim.getSimulationTime')))"
        assert page.js(calls) == [0] * 300
