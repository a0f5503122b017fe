# SPDX-License-Identifier: BSD-3-Clause
"""Pages that call functions with any values, or send any bytes, get answers or nothing; the server goes on."""

import asyncio
from collections.abc import Iterator
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bubblesim.web.tools import TOOLS
from page_client import page_client
from web_support import Node

VALUES = st.recursive(
    st.none()
    | st.booleans()
    | st.integers(-(2**63), 2**64 - 1)
    | st.floats()
    | st.text(max_size=10)
    | st.binary(max_size=10),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner, max_size=3),
    max_leaves=6,
)


@pytest.fixture(scope="module")
def node(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Node]:
    """A node with a window, whose server writes below a folder of the test."""
    folder = tmp_path_factory.mktemp("window")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        with Node(folder, "ball", "--paused") as node:
            yield node
    assert "Traceback" not in (folder / "node.err").read_text()


async def answer(node: Node, function: str, arguments: list[Any]) -> dict[str, Any]:
    async with page_client(node.origin) as page:
        await page.send(function, *arguments)
        return (await page.next_reply())[1]


@settings(max_examples=60)
@given(st.sampled_from(sorted(TOOLS)), st.lists(VALUES, max_size=4))
def test_a_call_with_any_values_is_answered(node: Node, function: str, arguments: list[Any]) -> None:
    assert asyncio.run(answer(node, function, arguments)).keys() <= {"ret", "err"}


@settings(max_examples=60)
@given(st.binary(max_size=60))
def test_after_any_bytes_a_page_is_answered(node: Node, data: bytes) -> None:
    async def afterwards() -> Any:
        async with page_client(node.origin) as page:
            await page.socket.send_bytes(data)
            return await page.call("server.recording")

    assert asyncio.run(afterwards())["runs"] is False
