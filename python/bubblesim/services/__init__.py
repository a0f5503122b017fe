# SPDX-License-Identifier: BSD-3-Clause
"""How other nodes control a running simulation."""
