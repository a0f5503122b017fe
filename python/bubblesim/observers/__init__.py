# SPDX-License-Identifier: BSD-3-Clause
"""What looks on while a simulation runs: recording, lockstep."""
