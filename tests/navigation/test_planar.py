# SPDX-License-Identifier: BSD-3-Clause
import math
from types import SimpleNamespace

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from bubblesim.controllers.planar_motion import Pose2D
from bubblesim.navigation.planar import hits, placed, pose_of, seen_from

metres = st.floats(-100, 100)
POSE = Pose2D(1.0, 2.0, math.pi / 2)


def test_a_point_ahead_and_one_to_the_left() -> None:
    assert seen_from(POSE, (1.0, 5.0)) == pytest.approx((3.0, 0.0))
    assert seen_from(POSE, (0.0, 2.0)) == pytest.approx((0.0, 1.0))


@settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])  # a busy machine may stand still
@given(metres, metres, st.floats(-10, 10), metres, metres)
def test_what_is_seen_lies_where_it_is(x: float, y: float, heading: float, px: float, py: float) -> None:
    pose = Pose2D(x, y, heading)
    assert placed(pose, seen_from(pose, (px, py))) == pytest.approx((px, py), abs=1e-9)


def test_a_transform_becomes_a_pose() -> None:
    rotation = SimpleNamespace(x=0.0, y=0.0, z=math.sin(0.5), w=math.cos(0.5))
    pose = pose_of(SimpleNamespace(translation=SimpleNamespace(x=1.0, y=2.0, z=3.0), rotation=rotation))
    assert (pose.x, pose.y, pose.heading) == pytest.approx((1.0, 2.0, 1.0))


def test_rays_become_points_but_for_those_that_have_met_nothing() -> None:
    scan = SimpleNamespace(
        angle_min=0.0,
        angle_increment=math.pi / 2,
        range_min=0.5,
        range_max=10.0,
        ranges=[1.0, math.inf, 2.0, math.nan, 0.1, 20.0],
    )
    lidar = Pose2D(0.2, 0.0, math.pi / 2)
    assert hits(scan, lidar) == [pytest.approx((0.2, 1.0)), pytest.approx((0.2, -2.0))]
