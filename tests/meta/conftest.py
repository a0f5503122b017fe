# SPDX-License-Identifier: BSD-3-Clause
from pathlib import Path

import pytest

from generator_support import Generator


@pytest.fixture
def generator(tmp_path: Path) -> Generator:
    return Generator(tmp_path)
