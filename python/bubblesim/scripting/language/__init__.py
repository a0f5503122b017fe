# SPDX-License-Identifier: BSD-3-Clause
"""From a script's source to callable code, in Python and in Lua."""
