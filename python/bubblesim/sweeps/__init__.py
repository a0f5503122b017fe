# SPDX-License-Identifier: BSD-3-Clause
"""Sweeps: runs of a program or a scene over seeds and parameters, in several processes or on a Ray cluster."""
