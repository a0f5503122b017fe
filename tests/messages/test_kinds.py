# SPDX-License-Identifier: BSD-3-Clause
from bubblesim.messages.kinds import has_header


def test_only_a_leading_header_counts() -> None:
    assert has_header(["std_msgs/Header", "float64"])
    assert not has_header(["float64", "std_msgs/Header"])
    assert not has_header([])
