# SPDX-License-Identifier: BSD-3-Clause
"""Experiments whose result is known from theory: each compares bubblesim with it, and on request with other engines."""
