# SPDX-License-Identifier: BSD-3-Clause
"""The program bubblesim: each command is one module here, with its arguments and its implementation."""
