# SPDX-License-Identifier: BSD-3-Clause
"""What every program of bubblesim needs: exit codes, output, addresses."""
