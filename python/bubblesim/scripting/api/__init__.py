# SPDX-License-Identifier: BSD-3-Clause
"""The functions for scripts, with checked arguments."""
