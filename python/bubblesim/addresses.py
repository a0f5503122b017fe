# SPDX-License-Identifier: BSD-3-Clause
"""Addresses on which servers listen."""

from __future__ import annotations

import ipaddress


def is_loopback(address: str) -> bool:
    """Return whether an address can be reached from this machine only."""
    try:
        return address == "localhost" or ipaddress.ip_address(address).is_loopback
    except ValueError:
        return False
