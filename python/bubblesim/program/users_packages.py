# SPDX-License-Identifier: BSD-3-Clause
"""Leaves out the packages of ``pip install --user``.

Debian's modules are made for each other: a newer numpy or matplotlib in ~/.local is not.
"""

from __future__ import annotations

import os
import site
import sys


def leave_out() -> None:
    """Import nothing from ~/.local from now on, in this program and in those that it starts."""
    os.environ["PYTHONNOUSERSITE"] = "1"
    sys.path = [folder for folder in sys.path if folder != site.getusersitepackages()]
