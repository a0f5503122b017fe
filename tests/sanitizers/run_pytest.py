# SPDX-License-Identifier: BSD-3-Clause
"""Run pytest in this process, which looks for leaks at its end; the programs that tests start do not.

The node ends without destroying everything, and shells and the tools of ROS have leaks of their own.
"""

import os
import sys

import pytest

os.environ["ASAN_OPTIONS"] += ":detect_leaks=0"
sys.exit(pytest.main(sys.argv[1:]))
