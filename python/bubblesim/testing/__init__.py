# SPDX-License-Identifier: BSD-3-Clause
"""Regression tests of controllers: pytest fixtures that run a simulator in lockstep. See plugin.py."""
