# SPDX-License-Identifier: BSD-3-Clause
import math

import pytest

from bubblesim.navigation.exploration import Explorer, frontiers
from bubblesim.navigation.path_planning import Footprint
from rooms import drawn

SLIM = Footprint(radius=0.1, comfort=0.1)
HALF_KNOWN = """
##########
#      ???
#      ???
#    # ???
##########
"""


def test_a_frontier_is_where_the_free_meets_the_unknown() -> None:
    (found,) = frontiers(drawn(HALF_KNOWN), (0.75, 0.75), SLIM, 0.2)
    assert found.length == pytest.approx(1.5)
    assert found.viewpoint == pytest.approx((3.25, 1.25))
    assert found.distance == pytest.approx(math.hypot(2.5, 0.5))


def test_the_nearest_comes_first_and_short_ones_do_not_count() -> None:
    grid = drawn("?        ??\n" + 3 * "         ??\n")
    found = frontiers(grid, (1.75, 1.25), SLIM, 0.2)
    assert [frontier.length for frontier in found] == pytest.approx([1.5, 2.0])
    assert [frontier.length for frontier in frontiers(grid, (1.75, 1.25), SLIM, 1.8)] == pytest.approx([2.0])


def test_a_room_without_unknown_is_explored() -> None:
    explorer = Explorer(SLIM)
    assert not explorer.update(drawn("####\n#  #\n#  #\n####"), (0.75, 0.75))
    assert explorer.goal is None


def test_what_cannot_be_seen_is_not_tried_for_ever() -> None:
    grid, place = drawn(HALF_KNOWN), (0.75, 0.75)
    explorer = Explorer(SLIM)
    assert explorer.update(grid, place)
    assert explorer.goal is not None
    explorer.discard_goal()
    assert not explorer.update(grid, place)
    assert explorer.goal is None


def test_a_goal_is_kept_until_its_frontier_is_known() -> None:
    place = (0.75, 0.75)
    explorer = Explorer(SLIM)
    explorer.update(drawn(HALF_KNOWN), place)
    assert not explorer.update(drawn(HALF_KNOWN), (2.75, 0.75))
    assert explorer.update(drawn(HALF_KNOWN.replace("?", " ", 6).replace("?", "#")), place)


def test_a_frontier_behind_a_gap_too_narrow_is_looked_at_from_this_side() -> None:
    grid = drawn("#########\n#   #   ?\n#       ?\n#   #   ?\n#########")
    (found,) = frontiers(grid, (0.75, 1.25), Footprint(radius=0.6, comfort=0.6), 0.2)
    assert found.viewpoint[0] < 2.0


def test_a_map_without_free_space_has_no_goal() -> None:
    explorer = Explorer(SLIM)
    explorer.update(drawn("???\n???"), (0.5, 0.5))
    assert explorer.goal is None
