# SPDX-License-Identifier: BSD-3-Clause
"""The program bubblesim: each of its commands is a file here, which says how it is called and does it."""
