# SPDX-License-Identifier: BSD-3-Clause
"""Runs the server: python -m bubblesim.web."""

import sys

from bubblesim.program.run import run_program
from bubblesim.web.program import main

sys.exit(run_program(main))
