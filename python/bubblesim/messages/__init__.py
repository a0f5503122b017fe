# SPDX-License-Identifier: BSD-3-Clause
"""Message types: where their definitions are found on a machine, and how they come to be known to bubblesim.

The build reads its lists with this package, before the compiled module exists: only `runtime` and `listing` need that.
"""
