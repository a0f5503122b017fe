# SPDX-License-Identifier: BSD-3-Clause
"""The state of a scene beside its physics, which scripts, programs and viewers share."""
