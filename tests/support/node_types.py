# SPDX-License-Identifier: BSD-3-Clause
"""Types of the fixtures of these tests."""

import subprocess
from collections.abc import Callable
from typing import Any

Start = Callable[..., "subprocess.Popen[str]"]
"""The fixture `node`: a node's name, its arguments, options of Popen."""

Ask = Callable[..., Any]
"""The fixture `ask`: rospy code, its arguments."""
