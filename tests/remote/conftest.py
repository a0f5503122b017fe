# SPDX-License-Identifier: BSD-3-Clause
"""The node of the tests of the remote API."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from remote_support import RemoteNode


@pytest.fixture
def node(tmp_path: Path) -> Iterator[RemoteNode]:
    with RemoteNode(tmp_path, "--speed", "max") as node:
        yield node
        assert node.process.poll() is None, node.output
