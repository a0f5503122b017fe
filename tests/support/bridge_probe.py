# SPDX-License-Identifier: BSD-3-Clause
"""Controls bridge_probe, the program that runs a RosBridge and executes commands (see bridge_probe.cpp)."""

import queue
import signal
import subprocess
import threading
import time
from collections.abc import Callable
from types import TracebackType

from ros_support import DEADLINE, built, start, stop


class Probe:
    def __init__(self, env: dict[str, str], *arguments: str) -> None:
        self.process = start(
            [str(built("bridge_probe")), *arguments],
            env,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
        self.events: list[str] = []
        """Lines that are not answers, oldest first: `message ID VALUE`, `paused`, `process_input threw ...`."""
        self.errors: list[str] = []
        """Lines on stderr."""
        self._answers: queue.Queue[str] = queue.Queue()
        self._threads = [threading.Thread(target=target) for target in (self._read_output, self._read_errors)]
        for thread in self._threads:
            thread.start()
        self.wait_for(lambda: "ready" in self.events or self.process.poll() is not None, "the probe to start")

    def __enter__(self) -> "Probe":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        stop(self.process)
        for thread in self._threads:
            thread.join()

    def ask(self, *words: object) -> str:
        """Return the answer to a command; it begins with `! ` if the bridge threw."""
        self.send(*words)
        answer = self._answers.get(timeout=DEADLINE)
        return answer[2:] if answer.startswith("= ") else answer

    def send(self, *words: object) -> None:
        """Send a command without waiting for its answer."""
        assert self.process.stdin is not None
        print(*words, file=self.process.stdin, flush=True)

    def messages(self, endpoint: str) -> list[str]:
        """Return what a subscriber has received so far."""
        prefix = f"message {endpoint} "
        return [event[len(prefix) :] for event in self.events if event.startswith(prefix)]

    def wait_for(self, condition: Callable[[], bool], what: str, timeout: float = DEADLINE) -> None:
        end = time.monotonic() + timeout
        while not condition():
            seen = "\n".join(self.events + self.errors)
            assert time.monotonic() < end, f"waited in vain for {what}; seen so far:\n{seen}"
            time.sleep(0.01)

    def terminate(self) -> float:
        """End it with SIGTERM; return the seconds until it has ended."""
        begin = time.monotonic()
        self.process.send_signal(signal.SIGTERM)
        self.process.wait(timeout=DEADLINE)
        for thread in self._threads:
            thread.join()
        return time.monotonic() - begin

    def _read_output(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            line = line.rstrip("\n")
            if line.startswith(("= ", "! ")) and "ready" in self.events:
                self._answers.put(line)
            else:
                self.events.append(line)

    def _read_errors(self) -> None:
        assert self.process.stderr is not None
        for line in self.process.stderr:
            self.errors.append(line.rstrip("\n"))
