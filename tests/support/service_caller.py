# SPDX-License-Identifier: BSD-3-Clause
"""Calls services like rosservice, many of them from one process: starting one per call takes a second."""

import json
import subprocess
from pathlib import Path
from types import TracebackType
from typing import Any

from ros_support import RosCore, start, stop


class ServiceCaller:
    """Calls services at a master; its process ends with the block."""

    def __init__(self, core: RosCore) -> None:
        command = ["/usr/bin/python3", str(Path(__file__).with_name("service_client.py"))]
        self._process = start(command, core.env, stdin=subprocess.PIPE, stdout=subprocess.PIPE)

    def __call__(self, service: str, **request: Any) -> Any:
        assert self._process.stdin
        assert self._process.stdout
        self._process.stdin.write(json.dumps([service, request]) + "\n")
        self._process.stdin.flush()
        return json.loads(self._process.stdout.readline())

    def __enter__(self) -> "ServiceCaller":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        stop(self._process)
