# SPDX-License-Identifier: BSD-3-Clause
"""Script code, in Python and in Lua."""
