# SPDX-License-Identifier: BSD-3-Clause
"""What a page has begun ends with it, and what the server has begun with the server."""

import asyncio
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from page_client import Server, page_client
from ros_support import RosCore, stop, wait_until
from web_support import TOKEN

TOPIC = "/watched"


@pytest.fixture
def server(roscore: RosCore, tmp_path: Path) -> Iterator[Server]:
    with Server(tmp_path, env=roscore.env | TOKEN) as running:
        try:
            yield running
        finally:
            roscore.resume()


def is_watched(core: RosCore) -> bool:
    return any("bubblesim_window" in node for node in core.state()["subscribers"].get(TOPIC, []))


def test_a_page_that_closes_during_a_call_of_ros_leaves_no_subscription(roscore: RosCore, server: Server) -> None:
    async def close_while_it_waits() -> None:
        async with page_client(server.origin) as page:
            await page.call("server.topics")
            roscore.pause()
            await page.send("server.watchTopic", TOPIC, "data")
            await asyncio.sleep(1)

    with roscore.publishing(TOPIC, "std_msgs/Float64", "1.0"):
        wait_until(lambda: TOPIC in roscore.state()["publishers"], "the publisher")
        asyncio.run(close_while_it_waits())
        roscore.resume()
        time.sleep(3)  # in which it subscribes
        wait_until(lambda: not is_watched(roscore), "the end of the subscription")


def test_a_page_that_closes_while_the_master_hangs_does_not_block_others(roscore: RosCore, server: Server) -> None:
    async def watch() -> None:
        async with page_client(server.origin) as page:
            await page.call("server.watchTopic", TOPIC, "data")
            wait_until(lambda: is_watched(roscore), "the subscription")
            roscore.pause()

    with roscore.publishing(TOPIC, "std_msgs/Float64", "1.0"):
        wait_until(lambda: TOPIC in roscore.state()["publishers"], "the publisher")
        asyncio.run(watch())
        time.sleep(0.5)
        begin = time.monotonic()
        assert server.get("/")[0] == 200
        assert time.monotonic() - begin < 5
        roscore.resume()
        wait_until(lambda: not is_watched(roscore), "the end of the subscription")


def test_the_server_ends_although_the_master_hangs(roscore: RosCore, server: Server) -> None:
    async def ask() -> None:
        async with page_client(server.origin) as page:
            await page.call("server.topics")
            roscore.pause()
            await page.send("server.topics")
            await asyncio.sleep(0.5)

    asyncio.run(ask())
    begin = time.monotonic()
    server.process.terminate()
    server.process.wait(20)
    assert time.monotonic() - begin < 12


def test_a_window_that_only_looks_publishes_nothing(roscore: RosCore, tmp_path: Path) -> None:
    async def look() -> None:
        async with page_client(server.origin) as page:
            await page.call("server.topics")
            await page.call("server.markers", -1)
            publishers = [node for nodes in roscore.state()["publishers"].values() for node in nodes]
            assert not any("bubblesim_window" in node for node in publishers)

    with Server(tmp_path, "--read-only", env=roscore.env | TOKEN) as server:
        asyncio.run(look())


def test_a_recording_ends_with_the_server(roscore: RosCore, server: Server) -> None:
    async def record() -> Path:
        async with page_client(server.origin) as page:
            return Path((await page.call("server.startRecording", ["/rosout"]))["file"])

    file = asyncio.run(record())
    assert Path(f"{file}.active").exists()
    server.process.kill()
    wait_until(file.exists, "the end of the recording")
    stop(server.process)
