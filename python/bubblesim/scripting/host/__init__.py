# SPDX-License-Identifier: BSD-3-Clause
"""Life cycle of child scripts: load, call, interrupt, end."""
