# SPDX-License-Identifier: BSD-3-Clause
"""The remote API server: CoppeliaSim's protocol for remote clients over ZeroMQ, and a client for Python."""
