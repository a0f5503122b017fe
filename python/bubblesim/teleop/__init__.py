# SPDX-License-Identifier: BSD-3-Clause
"""Driving by hand: keyboard, stick and joystick to velocities."""
