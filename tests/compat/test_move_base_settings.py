# SPDX-License-Identifier: BSD-3-Clause
"""The parameters of move_base, costmap_2d and their planners: which are read, and what they mean."""

from typing import Any

import pytest

from bubblesim.compat.move_base_settings import MoveBaseParameters, ObstacleLayer, Settings, read_settings
from bubblesim.compat.recovery import Recovery, RecoveryKind

SCANS = {"observation_sources": "scan cloud",
         "scan": {"data_type": "LaserScan", "topic": "front/scan", "marking": True},
         "cloud": {"data_type": "PointCloud2", "topic": "points"}}  # fmt: skip


def settings(**given: Any) -> Settings:
    return read_settings(MoveBaseParameters(given))


def test_without_parameters_there_are_defaults() -> None:
    found = settings()
    assert (found.map_frame, found.base_frame, found.map_topic, found.scan_topics) == (
        "map", "base_link", "map", ("scan",))  # fmt: skip
    assert (found.control_frequency, found.obstacle_layer, found.body) == (20.0, None, None)
    assert [each.name for each in found.recoveries] == [
        "conservative_reset", "rotate_recovery", "aggressive_reset", "aggressive_rotate"]  # fmt: skip


def test_the_planner_that_is_named_comes_first() -> None:
    planners = {
        "DWAPlannerROS": {"max_vel_x": 0.5, "max_vel_theta": 1.2, "acc_lim_x": 2.5, "xy_goal_tolerance": 0.2},
        "TebLocalPlannerROS": {"max_vel_x": 0.9, "min_turning_radius": 0.5, "yaw_goal_tolerance": 0.3},
    }
    driver = settings(base_local_planner="teb_local_planner/TebLocalPlannerROS", **planners).driver
    assert (driver.max_speed, driver.max_turn, driver.acceleration) == (0.9, 1.2, 2.5)
    assert (driver.tolerance, driver.yaw_tolerance, driver.turning_radius) == (0.2, 0.3, 0.5)
    assert settings(base_local_planner="dwa_local_planner/DWAPlannerROS", **planners).driver.max_speed == 0.5
    # An older name of it:
    assert settings(DWAPlannerROS={"max_trans_vel": 0.4, "max_rot_vel": 0.7}).driver.max_turn == 0.7


def test_a_footprint_is_the_outline_and_a_radius_replaces_it() -> None:
    footprint = [[-0.3, -0.2], [-0.3, 0.2], [0.5, 0.2], [0.5, -0.2]]
    found = settings(local_costmap={"footprint": footprint, "footprint_padding": 0.05})
    assert found.footprint.radius == pytest.approx(0.25)
    assert found.body is not None
    assert found.body.centres == pytest.approx([-0.2, 0.1, 0.4])  # three discs over 0.9 m, about x = 0.1
    assert found.body.radius == pytest.approx((0.15**2 + 0.25**2) ** 0.5)
    assert settings(global_costmap={"footprint": str(footprint)}).body is not None  # as some files have it
    round_one = settings(global_costmap={"footprint": footprint, "robot_radius": 0.2})
    assert (round_one.body, round_one.driver.radius) == (None, 0.2)
    with pytest.raises(ValueError, match="must be a list of points"):
        settings(global_costmap={"footprint": [0.1, 0.2]})


def test_a_costmap_without_a_static_layer_is_made_of_scans() -> None:
    plugins = [
        {"name": "seen", "type": "costmap_2d::ObstacleLayer"},
        {"name": "far", "type": "costmap_2d::InflationLayer"},
    ]
    costmap = {"plugins": plugins, "static_map": True, "seen": SCANS, "width": 40.0, "height": 30.0,
               "origin_x": -20.0, "origin_y": -15.0, "update_frequency": 10.0, "global_frame": "odom"}  # fmt: skip
    found = settings(global_costmap=costmap)
    assert found.obstacle_layer == ObstacleLayer((40.0, 30.0), (-20.0, -15.0), 0.05, False, 10.0)
    assert (found.map_frame, found.scan_topics) == ("odom", ("front/scan",))
    older = settings(global_costmap={"static_map": False, "rolling_window": True, **SCANS})
    assert older.obstacle_layer is not None
    assert older.obstacle_layer.rolls
    layers = [{"name": "map", "type": "costmap_2d::StaticLayer"}, *plugins]
    assert settings(global_costmap={"plugins": layers}).obstacle_layer is None


def test_recovery_behaviors_are_those_that_are_listed() -> None:
    listed = [{"name": "reset", "type": "clear_costmap_recovery/ClearCostmapRecovery"},
              {"name": "spin", "type": "rotate_recovery/RotateRecovery"}]  # fmt: skip
    found = settings(recovery_behaviors=listed, reset={"reset_distance": 1.5}).recoveries
    assert found == (Recovery("reset", RecoveryKind.CLEAR, 1.5), Recovery("spin", RecoveryKind.ROTATE, 3.0))
    assert settings(recovery_behavior_enabled=False).recoveries == ()
    kinds = [each.kind for each in settings(clearing_rotation_allowed=False, conservative_reset_dist=2.0).recoveries]
    assert kinds == [RecoveryKind.CLEAR] * 2
    with pytest.raises(ValueError, match="'slow' has the type move_slow_and_clear/MoveSlowAndClear; use ClearCostmap"):
        settings(recovery_behaviors=[{"name": "slow", "type": "move_slow_and_clear/MoveSlowAndClear"}])


def test_parameters_that_are_not_read_are_named() -> None:
    parameters = MoveBaseParameters({
        "controller_frequency": 10.0, "planner_frequency": 1.0,
        "DWAPlannerROS": {"max_vel_x": 0.5, "sim_time": 1.7}, "global_costmap": {"transform_tolerance": 0.5, **SCANS},
    })  # fmt: skip
    assert read_settings(parameters).control_frequency == 10.0
    assert parameters.without_effect() == [
        "DWAPlannerROS/sim_time", "global_costmap/cloud/topic", "global_costmap/scan/marking",
        "global_costmap/transform_tolerance", "planner_frequency",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("given", "problem"),
    [
        ({"controller_frequency": 0.0}, "controller_frequency is 0.0, must be above 0"),
        ({"DWAPlannerROS": {"max_vel_x": -1.0}}, "max_speed of the planner is -1.0, must be above 0"),
        ({"DWAPlannerROS": {"max_vel_x": "fast"}}, "could not convert string to float: 'fast'"),
    ],
)
def test_values_that_cannot_be_used_are_errors(given: dict[str, Any], problem: str) -> None:
    with pytest.raises(ValueError, match=problem):
        settings(**given)
