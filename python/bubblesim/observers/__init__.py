# SPDX-License-Identifier: BSD-3-Clause
"""Observers of a running simulation: recording, lockstep."""
