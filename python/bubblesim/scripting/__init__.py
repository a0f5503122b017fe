# SPDX-License-Identifier: BSD-3-Clause
"""Child scripts: what they may call, and the host that runs them."""
