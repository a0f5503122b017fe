# SPDX-License-Identifier: BSD-3-Clause
"""The same poses shown by viser: CPU time and bytes of a frame, beside those of the window's server.

Both servers send 1,000 boxes that turn to a client that takes all it is sent:

    python benchmarks/window/viser_peer.py [--rounds N] [--seconds S]
"""

import argparse
import asyncio
import multiprocessing
import statistics
import tempfile
import time
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from multiprocessing.sharedctypes import Synchronized
from pathlib import Path

import aiohttp
import numpy as np
import viser
from window import BODIES, Client, boxes, cpu_time, window_of

RATE = 5  # frames a second, which viser keeps up with
PORT = 23480


def show(ready: Connection, frames: "Synchronized[int]") -> None:
    """Show boxes in viser, and turn them at the rate; count the frames."""
    server = viser.ViserServer(port=PORT, verbose=False)
    shown = [
        server.scene.add_box(f"/box_{i}", dimensions=(0.2, 0.2, 0.2), position=((i % 40) * 0.5, (i // 40) * 0.5, 1.0))
        for i in range(BODIES)
    ]
    places = np.arange(BODIES)
    ready.send(True)
    begin = time.monotonic()
    for frame in range(1, 1_000_000):
        angle = frame / 100 + places
        turns = np.stack([np.cos(angle), 0 * angle, 0 * angle, np.sin(angle)], axis=1)
        heights = 1.0 + 0.1 * np.sin(frame / 10 + places)
        with server.atomic():
            for i, box in enumerate(shown):
                box.position = ((i % 40) * 0.5, (i // 40) * 0.5, heights[i])
                box.wxyz = turns[i]
        frames.value = frame
        time.sleep(max(begin + frame / RATE - time.monotonic(), 0))


async def take(seconds: float) -> int:
    """Return the number of bytes that viser sends to a client."""
    address = f"ws://127.0.0.1:{PORT}"
    protocol = f"viser-v{viser.__version__}"
    size = 0
    async with (
        aiohttp.ClientSession() as session,
        session.ws_connect(address, protocols=[protocol], max_msg_size=0) as socket,
    ):
        end = time.monotonic() + seconds
        async for message in socket:
            size += len(message.data)
            if time.monotonic() > end:
                break
    return size


def children(process: int) -> list[int]:
    """Return the processes that a process has started."""
    return [int(child) for child in Path(f"/proc/{process}/task/{process}/children").read_text().split()]


@dataclass
class Cost:
    """Of one server, by round."""

    cpu: list[float] = field(default_factory=list)  # s, of a frame
    size: list[float] = field(default_factory=list)  # bytes, of a body and frame

    def text(self) -> str:
        """Return the medians in one line."""
        return f"{1000 * statistics.median(self.cpu):.2f} ms a frame, {statistics.median(self.size):.0f} bytes a body"


def measure(rounds: int, seconds: float) -> None:
    """Measure both in turns, and print the medians."""
    ours, theirs = Cost(), Cost()
    ready, sender = multiprocessing.Pipe()
    frames = multiprocessing.Value("i", 0)
    peer = multiprocessing.Process(target=show, args=(sender, frames), daemon=True)
    peer.start()
    ready.recv()
    with tempfile.TemporaryDirectory() as name, window_of(boxes(Path(name)), Path(name)) as (node, address):
        (server,) = children(node)
        asyncio.run(Client().read(address, 2))
        for _ in range(rounds):
            client, before = Client(), cpu_time(server)
            asyncio.run(client.read(address, seconds))
            ours.cpu.append((cpu_time(server) - before) / len(client.sizes))
            ours.size.append(statistics.mean(client.sizes) / BODIES)
            before, first = cpu_time(peer.pid or 0), frames.value
            size = asyncio.run(take(seconds))
            shown = frames.value - first
            theirs.cpu.append((cpu_time(peer.pid or 0) - before) / shown)
            theirs.size.append(size / shown / BODIES)
    peer.terminate()
    print(f"window: {ours.text()}\nviser:  {theirs.text()}")
    print(f"viser's CPU time is {statistics.median(theirs.cpu) / statistics.median(ours.cpu):.0f} x that of the window")


def main() -> None:
    """Measure with the given options."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=4.0, help="of a round")
    options = parser.parse_args()
    measure(options.rounds, options.seconds)


if __name__ == "__main__":
    main()
