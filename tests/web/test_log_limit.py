# SPDX-License-Identifier: BSD-3-Clause
"""What anyone can make the window's server log."""

import subprocess
import sys

PROGRAM = """
import logging
from bubblesim.web.log_limit import limit_log

logging.basicConfig()
limit_log()
for number in range(200):
    logging.getLogger(("aiohttp.server", "asyncio")[number % 2]).error("bad request")
"""


def test_ten_errors_of_connections_are_logged_in_a_minute() -> None:
    run = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, check=True)
    assert run.stderr.count("bad request") == 10
    assert run.stderr.count("are left out for one minute") == 1
