# SPDX-License-Identifier: BSD-3-Clause
"""The functions of simUI."""
