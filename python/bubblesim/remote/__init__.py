# SPDX-License-Identifier: BSD-3-Clause
"""The door for programs outside: CoppeliaSim's protocol for remote clients over ZeroMQ, and a client for Python."""
