# SPDX-License-Identifier: BSD-3-Clause
"""A robot in a running node, and a peer on its topics."""

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

import pytest

from node_support import Node
from ros_peer import Peer
from ros_support import RosCore


@dataclass
class Run:
    """A scene in a node, and its peer."""

    core: RosCore
    node: Node
    peer: Peer


@pytest.fixture(scope="package")
def shared_core(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RosCore]:
    with RosCore(tmp_path_factory.mktemp("devices")) as core:
        yield core


@pytest.fixture(scope="module")
def run(shared_core: RosCore, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Callable[..., Run]]:
    """Run a scene until the module's tests have finished."""
    with ExitStack() as ends:

        def begin(scene: Path | str, *options: str) -> Run:
            folder = tmp_path_factory.mktemp("run")
            node = ends.enter_context(Node(shared_core.env, folder / "log", scene, *options))
            return Run(shared_core, node, ends.enter_context(Peer(shared_core, folder / "received")))

        yield begin


@pytest.fixture
def peer(running: Run) -> Peer:
    """The peer of the scene of a file, with all models at their starts."""
    running.peer.call("/gazebo/reset_world")
    return running.peer
