# SPDX-License-Identifier: BSD-3-Clause
"""Records topics to a bag, for pages."""

from __future__ import annotations

import asyncio
import datetime
import signal
import subprocess
import time
from pathlib import Path
from typing import Any

from bubblesim.web import ros_topics
from bubblesim.web.threads import in_thread

_BEGIN = 30.0  # s until rosbag has opened its file
_GRACE = 30.0  # s for the index of the bag


def _recorder() -> str:
    """Return the program that ``rosbag record`` starts: after a signal rosbag itself does not wait until it has closed
    the bag."""
    import rospkg
    from roslib.packages import find_node

    try:
        found = find_node("rosbag", "record")
    except rospkg.ResourceNotFound:
        found = []
    if not found:
        raise RuntimeError("rosbag is not installed: apt install python3-rosbag")
    return str(found[0])


class Recording:
    """One recording at a time, for all pages."""

    def __init__(self) -> None:
        """Create it without a recording."""
        self._process: subprocess.Popen[bytes] | None = None
        self._file = ""  # as soon as rosbag has opened it

    def state(self) -> dict[str, Any]:
        """Return whether it ``runs``, and its ``file``."""
        return {"runs": bool(self._file) and self._is_busy(), "file": self._file}

    def _is_busy(self) -> bool:
        return self._process is not None and self._process.poll() is None

    async def start(self, topics: list[str]) -> dict[str, Any]:
        """Record topics, or all without a list, to a new file in the folder where the server was started."""
        if self._is_busy():
            raise RuntimeError(f"{self._file or 'a bag'} is being recorded already")
        await in_thread(ros_topics.node)
        program = await in_thread(_recorder)
        for topic in topics:
            if not topic.startswith("/"):
                raise ValueError(f"'{topic}' is not the name of a topic: it must begin with /")
        now = datetime.datetime.now().astimezone()
        file = str(Path.cwd() / f"bubblesim_{now:%Y-%m-%d_%H-%M-%S}.bag")
        # The kernel ends it with the server, also if that is killed.
        command = ["setpriv", "--pdeathsig", "INT", program, "-q", "-O", file, *(topics or ["-a"])]
        self._file = ""
        self._process = subprocess.Popen(command, stdin=subprocess.DEVNULL, start_new_session=True)
        try:
            await self._wait_for(file)
        except asyncio.CancelledError:  # the page has closed: no page knows of this recording
            self.close()
            raise
        self._file = file
        return self.state()

    async def _wait_for(self, file: str) -> None:
        """Wait until rosbag has opened the file: one that is ended before leaves none."""
        end = time.monotonic() + _BEGIN
        while not Path(f"{file}.active").exists():
            if not self._is_busy():
                raise RuntimeError(f"rosbag has ended before it opened {file}: see the output of the window")
            if time.monotonic() > end:
                await self.stop()
                raise RuntimeError(f"rosbag has not opened {file} within {_BEGIN:g} s")
            await asyncio.sleep(0.05)

    async def stop(self) -> dict[str, Any]:
        """End the recording, and wait for its file."""
        process = self._process
        if process is not None and process.poll() is None:
            process.send_signal(signal.SIGINT)
            try:
                await in_thread(process.wait, _GRACE)
            except subprocess.TimeoutExpired:
                process.terminate()
        self._process = None  # not before: until then pages show that it runs, and its file has another name
        return self.state()

    def close(self) -> None:
        """End a recording with the server."""
        if self._process is not None and self._is_busy():
            self._process.send_signal(signal.SIGINT)


recording = Recording()
