# SPDX-License-Identifier: BSD-3-Clause
import sys
from pathlib import Path

from ros_support import roscore as roscore

sys.path.insert(0, str(Path(__file__).parents[1] / "meta"))  # for workspace_support.py
