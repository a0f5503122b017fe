# SPDX-License-Identifier: BSD-3-Clause
"""Message types: find their definitions on this machine and register them.

The build uses this package before the compiled module exists: only `runtime` and `listing` need that module.
"""
