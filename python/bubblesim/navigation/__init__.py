# SPDX-License-Identifier: BSD-3-Clause
"""Maps of the plane and driving on them: pure logic, which the nodes in scripts connect to topics."""
