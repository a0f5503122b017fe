# SPDX-License-Identifier: BSD-3-Clause
"""What scripts can call: functions with checked arguments."""
