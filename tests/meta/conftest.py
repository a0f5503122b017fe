# SPDX-License-Identifier: BSD-3-Clause
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))  # for generator_support.py

from generator_support import Generator


@pytest.fixture
def generator(tmp_path: Path) -> Generator:
    return Generator(tmp_path)
