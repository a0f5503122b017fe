# SPDX-License-Identifier: BSD-3-Clause
"""Child scripts: the functions for them, and the host that runs them."""
