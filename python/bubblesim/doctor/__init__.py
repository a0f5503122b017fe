# SPDX-License-Identifier: BSD-3-Clause
"""Checks of the installation: find problems and suggest fixes."""
