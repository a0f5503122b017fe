# SPDX-License-Identifier: BSD-3-Clause
"""The node of the tests of the door."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from door_support import Door


@pytest.fixture
def door(tmp_path: Path) -> Iterator[Door]:
    with Door(tmp_path, "--speed", "max") as door:
        yield door
        assert door.process.poll() is None, door.output
