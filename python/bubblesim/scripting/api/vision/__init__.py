# SPDX-License-Identifier: BSD-3-Clause
"""Image processing: the functions of simVision."""
