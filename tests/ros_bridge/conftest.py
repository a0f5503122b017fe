# SPDX-License-Identifier: BSD-3-Clause
import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).parents[1])]

from ros_support import roscore  # noqa: E402, F401  (a fixture of all tests here)
