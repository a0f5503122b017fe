# SPDX-License-Identifier: BSD-3-Clause
from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from pathlib import Path

import pytest

from node_support import Node, write
from remote_control import Remote, Run
from ros_support import RosCore


@pytest.fixture
def run(roscore: RosCore, tmp_path: Path) -> Iterator[Run]:
    """Run the ball with a test's script, and the remote control."""
    with ExitStack() as ends:

        def begin(code: str, *options: str, subscribe: Sequence[str] = ()) -> tuple[Node, Remote]:
            file = write(tmp_path / "script.py", code)
            arguments = ["ball", "--child-script", f"/Ball={file}", *options]
            node = ends.enter_context(Node(roscore.env, tmp_path / "log", *arguments))
            return node, ends.enter_context(Remote(roscore.env, tmp_path / "received", *subscribe))

        yield begin
