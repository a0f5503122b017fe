# SPDX-License-Identifier: BSD-3-Clause
"""Regression tests of controllers: fixtures of pytest that run a simulator in step with them. See plugin.py."""
