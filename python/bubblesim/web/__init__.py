# SPDX-License-Identifier: BSD-3-Clause
"""The server of the window: a process of its own between the pages in browsers and the remote API server of a node."""
