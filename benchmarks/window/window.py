# SPDX-License-Identifier: BSD-3-Clause
"""Cost of a page that takes every frame: CPU and steps of the simulator, latency and size of frames, the first picture.

Runs the node with a window, and a client that reads frames as the page does, in rounds with and without the client:

    python benchmarks/window/window.py [--rounds N] [--seconds S]
"""

import argparse
import asyncio
import contextlib
import itertools
import os
import re
import statistics
import struct
import subprocess
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import aiohttp
import cbor2
from playwright.sync_api import sync_playwright

import bubblesim
from bubblesim.running.places import node_program

BODIES = 1000
PORT = 23470


# Step times as a script sees them: the distances of its calls, at full speed.
STEP_TIMES = """\
import time

def sysCall_init():
    self.calls = []

def sysCall_actuation():
    self.calls.append(time.perf_counter())

def take():
    calls, self.calls = self.calls, []
    return calls
"""


def boxes(folder: Path) -> str:
    """Write a scene of boxes that turn in the air, so that none of them sleeps; return its file."""
    models = "".join(
        f'<model name="box_{i}"><pose>{(i % 40) * 0.5} {(i // 40) * 0.5} 1 0 0 0</pose><link name="link">'
        "<gravity>false</gravity><visual name='v'><geometry><box><size>.2 .2 .2</size></box></geometry></visual>"
        "<collision name='c'><geometry><box><size>.2 .2 .2</size></box></geometry></collision></link></model>"
        for i in range(BODIES)
    )
    file = folder / "boxes.sdf"
    file.write_text(f'<sdf version="1.9"><world name="boxes">{models}</world></sdf>')
    return str(file)


def cpu_time(process: int) -> float:
    """Return the CPU time of a process in s."""
    return time.clock_gettime((~process << 3) | 2)  # as clock_getcpuclockid(3)


class Client:
    """Reads frames as a page does."""

    def __init__(self) -> None:
        """Start without frames."""
        self.latencies: list[float] = []
        self.sizes: list[int] = []

    async def read(self, address: str, seconds: float) -> None:
        """Read frames for a time."""
        origin, _, token = address.partition("/#token=")
        async with (
            aiohttp.ClientSession() as session,
            session.ws_connect(f"{origin}/socket", headers={"Origin": origin}, max_msg_size=0) as socket,
        ):
            await socket.send_str(token)
            end = time.monotonic() + seconds
            async for message in socket:
                if message.data[0] == 0:
                    (written,) = struct.unpack_from("<d", message.data, 16)
                    self.latencies.append(time.monotonic() - written)
                    self.sizes.append(len(message.data))
                    await socket.send_bytes(cbor2.dumps([struct.unpack_from("<I", message.data, 4)[0]]))
                if time.monotonic() > end:
                    return


def first_picture(address: str, openings: int) -> float:
    """Return the median time in s from opening the address to a picture of the whole scene, drawn without a GPU."""
    times = []
    with sync_playwright() as playwright:
        flags = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-sandbox"]
        browser = playwright.chromium.launch(executable_path="/usr/bin/chromium-headless-shell", args=flags)
        for _ in range(openings):
            page = browser.new_context(viewport={"width": 1000, "height": 620}).new_page()
            begin = time.monotonic()
            page.goto(address)
            while not page.evaluate("Boolean(window.bubblesim?.scene.models.length && bubblesim.link.frame)"):
                time.sleep(0.02)
            page.evaluate("bubblesim.view.settled()")
            times.append(time.monotonic() - begin)
            page.context.close()
        browser.close()
    return statistics.median(times)


@contextlib.contextmanager
def window_of(scene: str, folder: Path, *options: str) -> Iterator[tuple[int, str]]:
    """Run a node with a window; yield its process and the address."""
    log = folder / "log"
    command = [str(node_program()), scene, "--no-ros", "--web", *options]
    environment = os.environ | {"BUBBLESIM_WEB_TOKEN": "benchmark"}
    with log.open("w") as output, subprocess.Popen(command, env=environment, stderr=output) as node:
        try:
            while not (found := re.search(r"the window is at (\S+)", log.read_text())):
                time.sleep(0.2)
            yield node.pid, f"{found[1]}#token=benchmark"
        finally:
            node.terminate()


def step_times(scene: str, model: str, folder: Path, rounds: int, seconds: float) -> None:
    """Print the 99th percentile of the step times at full speed, with a page relative to that without."""
    script = folder / "step_times.py"
    script.write_text(STEP_TIMES)
    options = ["--speed", "max", "--remote", str(PORT), "--start", "--child-script", f"{model}={script}"]
    ratios = []
    with window_of(scene, folder, *options) as (_, address), bubblesim.connect(PORT) as simulator:
        asyncio.run(Client().read(address, 2))

        def late_step() -> float:
            calls = simulator.call("sim.callScriptFunction", "take", model)
            return statistics.quantiles([b - a for a, b in itertools.pairwise(calls)], n=100)[-1]

        late_step()
        for _ in range(rounds):
            time.sleep(seconds)
            alone = late_step()
            asyncio.run(Client().read(address, seconds))
            ratios.append(late_step() / alone)
    print(f"  step times at full speed, 99th percentile with a page: {statistics.median(ratios):.3f} x")


def measure(name: str, scene: str, folder: Path, rounds: int, seconds: float) -> None:
    """Print the figures of a scene."""
    client = Client()
    ratios = []
    with window_of(scene, folder, "--speed", "3") as (process, address):
        asyncio.run(client.read(address, 2))  # begins to share frames
        for _ in range(rounds):
            before = cpu_time(process)
            time.sleep(seconds)
            alone = cpu_time(process) - before
            before = cpu_time(process)
            asyncio.run(client.read(address, seconds))
            ratios.append((cpu_time(process) - before) / alone)
        opened = first_picture(address, 5)
    late = statistics.quantiles(client.latencies, n=20)[-1]
    rate = len(client.latencies) / (2 + rounds * seconds)
    print(
        f"{name}: CPU of the simulator with a page {statistics.median(ratios):.3f} x (median of {rounds}); "
        f"{rate:.0f} frames/s of {statistics.median(client.sizes):.0f} bytes; "
        f"latency median {1000 * statistics.median(client.latencies):.1f} ms, p95 {1000 * late:.1f} ms; "
        f"first picture after {opened:.2f} s"
    )


def main() -> None:
    """Measure the tricycle and a scene of many bodies."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("--seconds", type=float, default=5.0, help="of a round")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for title, scene, model in (
            ("tricycle", "tricycle", "/Tricycle"),
            (f"{BODIES} bodies", boxes(folder), "/box_0"),
        ):
            measure(title, scene, folder, options.rounds, options.seconds)
            step_times(scene, model, folder, options.rounds, options.seconds)


if __name__ == "__main__":
    main()
