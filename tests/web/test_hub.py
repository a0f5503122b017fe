# SPDX-License-Identifier: BSD-3-Clause
"""The server of the window follows simulators, whatever becomes of them."""

import asyncio
import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import cbor2
import pytest
import zmq

from node_support import Node
from page_client import Server, page_client
from ros_support import ros_environment, wait_until


@contextmanager
def server_of_unreadable_frames(address: str, frames: str) -> Iterator[list[str]]:
    """Answer requests as a node does whose frames cannot be read; yield the functions that were called."""
    calls: list[str] = []
    ending = threading.Event()
    context = zmq.Context()
    socket = context.socket(zmq.ROUTER)
    socket.bind(address)

    def answer() -> None:
        while not ending.is_set():
            if socket.poll(50):
                peer, _, request = socket.recv_multipart()
                calls.append(cbor2.loads(request)["func"])
                socket.send_multipart([peer, b"", cbor2.dumps({"ret": [{"frames": frames, "next_event": 0}]})])
        socket.close(0)

    thread = threading.Thread(target=answer)
    thread.start()
    try:
        yield calls
    finally:
        ending.set()
        thread.join()
        context.term()


@pytest.mark.parametrize("frames", ["/proc/1/fd/999", "/dev/null"])
def test_frames_that_cannot_be_read_are_reported_once_and_tried_again(tmp_path: Path, frames: str) -> None:
    with Server(tmp_path) as server:
        with server_of_unreadable_frames(f"tcp://127.0.0.1:{server.remote_port}", frames) as calls:
            wait_until(lambda: len(calls) > 3, "further tries")
        assert server.output.count("cannot show the simulator") == 1
        assert frames in server.output

        async def scene() -> object:
            async with page_client(server.origin) as page:
                return (await page.wait_for_event("scene"))["scene"]

        env = ros_environment(1, tmp_path)
        with Node(env, tmp_path / "node.txt", "ball", "--no-ros", f"--remote={server.remote_port}"):
            assert asyncio.run(scene()) == "ball"


def test_the_remote_api_can_be_a_socket_in_a_folder(tmp_path: Path) -> None:
    path = tmp_path / "api"
    if len(os.fsencode(path)) > 100:
        pytest.skip("the path is too long for a socket")
    with (
        server_of_unreadable_frames(f"ipc://{path}", "/dev/null") as calls,
        Server(tmp_path, "--remote", str(path)),
    ):
        wait_until(lambda: "window.share" in calls, "the server")
