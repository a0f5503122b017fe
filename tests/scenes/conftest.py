# SPDX-License-Identifier: BSD-3-Clause
"""A test's child script in a running node."""

import signal
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from node_support import Node, write
from ros_support import RosCore

Script = Callable[..., Node]


@pytest.fixture
def script(roscore: RosCore, tmp_path: Path) -> Iterator[Script]:
    """Run a script on the ball."""
    nodes: list[Node] = []

    def run(code: str, name: str = "script.py") -> Node:
        file = write(tmp_path / name, code)
        nodes.append(Node(roscore.env, tmp_path / "log", "ball", "--child-script", f"/Ball={file}"))
        nodes[-1].wait_until_listed(roscore)
        return nodes[-1]

    yield run
    for node in nodes:
        code = node.process.poll()
        assert code is None or code >= 0, f"the node crashed ({code}): {node.output}"
        if code is None:
            ended = 3 if "is disabled" in node.output else 0
            code = node.end()
            assert code in (ended, -signal.SIGINT), node.output  # on a busy machine it ends before it has cleaned up
