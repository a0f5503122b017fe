# SPDX-License-Identifier: BSD-3-Clause
"""What learning in many worlds needs beside them; the environments for Gymnasium are in gym_tasks."""
