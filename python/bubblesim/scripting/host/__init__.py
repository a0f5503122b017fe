# SPDX-License-Identifier: BSD-3-Clause
"""The life of child scripts: loaded, called, broken off, ended."""
