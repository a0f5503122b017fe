# SPDX-License-Identifier: BSD-3-Clause
"""A node of another library in its own process: it reads commands as JSON lines and writes what it receives as such."""

import base64
import json
import subprocess
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from ros_support import start, stop


class PeerProcess:
    """Ends with the block. Messages are dicts; bytes stay bytes."""

    def __init__(self, command: list[str], env: dict[str, str], log: Path) -> None:
        self._log = log
        self._read = 0
        self._received: dict[str, list[Any]] = {}
        with log.open("w") as output:
            self._process = start(command, env, stdin=subprocess.PIPE, stdout=output)

    def _send(self, **command: Any) -> None:
        assert self._process.stdin is not None
        self._process.stdin.write(json.dumps(command) + "\n")
        self._process.stdin.flush()

    def _take_in(self) -> None:
        with self._log.open("rb") as log:
            log.seek(self._read)
            for line in log:
                if not line.endswith(b"\n"):
                    break  # not written completely yet
                self._read += len(line)
                topic, message = json.loads(line, object_hook=_with_bytes)
                self._received.setdefault(topic, []).append(message)

    def close(self) -> None:
        stop(self._process)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()


def _with_bytes(found: dict[str, Any]) -> Any:
    return base64.b64decode(found["base64"]) if found.keys() == {"base64"} else found
