# SPDX-License-Identifier: BSD-3-Clause
"""A Python program that is ended by Ctrl-C."""

import os
import signal
import subprocess
import time

from ros_support import DEADLINE


def errors_of_interrupted(code: str) -> str:
    """Run a program that prints a line before a long call, interrupt the call, and return its stderr."""
    process = subprocess.Popen(
        ["/usr/bin/python3", "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=os.environ
    )
    try:
        assert process.stdout is not None
        process.stdout.readline()
        time.sleep(0.2)
        process.send_signal(signal.SIGINT)
        return process.communicate(timeout=DEADLINE)[1]
    finally:
        process.kill()
        process.wait()
