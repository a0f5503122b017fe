# SPDX-License-Identifier: BSD-3-Clause
"""Scene files as such: their check, and the reference page of their elements."""
