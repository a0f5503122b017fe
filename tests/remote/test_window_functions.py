# SPDX-License-Identifier: BSD-3-Clause
"""The table of the functions of the window."""

from types import SimpleNamespace

import pytest

from bubblesim.remote.window.functions import by_name


def test_two_functions_of_one_name_are_refused() -> None:
    def get_pose() -> None:
        """Stand for a function of one subject."""

    first = SimpleNamespace(FUNCTIONS=[get_pose])

    def get_pose() -> None:  # type: ignore[no-redef]
        """Stand for a function of another subject."""

    with pytest.raises(TypeError, match=r"two functions 'window\.get_pose'"):
        by_name([first, SimpleNamespace(FUNCTIONS=[get_pose])])
