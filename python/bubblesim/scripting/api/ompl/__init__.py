# SPDX-License-Identifier: BSD-3-Clause
"""The module `simOMPL`: motion planning on OMPL."""
