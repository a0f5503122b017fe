# SPDX-License-Identifier: BSD-3-Clause
"""Sensor readings in Python, in the scene `sensors`: a room with known walls."""

import numpy as np
import pytest

import bubblesim

FRONT_WALL, LEFT_WALL = 4.0, 3.0  # m from the mast, their near faces
EXACT = 1e-4  # m


@pytest.fixture
def room() -> bubblesim.Simulation:
    return bubblesim.Simulation("sensors")


def test_a_scan_has_its_rings_and_angles(room: bubblesim.Simulation) -> None:
    scan = room.object("/RingLidar").reading
    assert isinstance(scan, bubblesim.LidarScan)
    assert (scan.ranges.shape, scan.ranges.dtype) == ((16, 900), np.float32)
    assert (scan.intensities.shape, scan.intensities.dtype) == ((16, 900), np.float32)
    np.testing.assert_allclose(scan.elevations, np.linspace(-0.5, 0.25, 16))
    assert (scan.angles[0], scan.angles[-1]) == (pytest.approx(-np.pi), pytest.approx(3.134611))
    assert (scan.min_range, scan.max_range) == (0.1, 8)


def test_a_scan_measures_the_room(room: bubblesim.Simulation) -> None:
    scan = room.object("/Lidar").reading
    ranges = dict(zip(np.rad2deg(scan.angles).round().astype(int), scan.ranges[0], strict=True))
    assert ranges[90] == pytest.approx(LEFT_WALL, abs=EXACT)
    assert ranges[180] == np.inf, "there is no wall behind"
    # The ball's circle at the lidar's height: centre (2.2, -0.2), radius sqrt(0.3^2 - 0.2^2).
    assert ranges[0] == pytest.approx(2.2 - np.sqrt(0.05 - 0.04), abs=EXACT)


def test_a_picture_has_its_rows_and_columns(room: bubblesim.Simulation) -> None:
    image = room.object("/Camera").reading
    assert isinstance(image, bubblesim.CameraImage)
    assert (image.rgb.shape, image.rgb.dtype) == ((480, 640, 3), np.uint8)
    assert (image.depth.shape, image.depth.dtype) == ((480, 640), np.float32)
    assert (image.objects.shape, image.objects.dtype) == ((480, 640), np.int32)
    assert (image.horizontal_fov, image.near, image.far) == (1.3, 0.05, 20)


def test_a_picture_knows_what_it_shows(room: bubblesim.Simulation) -> None:
    image = room.object("/Camera").reading
    ball, floor = (room.object(path).handle for path in ("/Ball/link", "/Floor/link"))
    assert {ball, floor} < set(np.unique(image.objects).tolist())
    red, green, blue = image.rgb[image.objects == ball].mean(axis=0)
    assert red > 3 * max(green, blue)
    rows, columns = np.nonzero(image.objects == ball)
    assert rows.mean() > 240, "the ball lies below the middle"
    assert columns.mean() > 320, "and to the right"


def test_a_depth_camera_has_no_picture(room: bubblesim.Simulation) -> None:
    image = room.object("/DepthCamera").reading
    assert image.rgb is None
    # The axis points down by 0.25 rad from a metre above the floor; the outer rows are 23.5 pixels off the axis.
    off = 23.5 / (32 / np.tan(1.3 / 2))
    assert image.depth[47, 32] == pytest.approx(1 / (np.sin(0.25) + off * np.cos(0.25)), abs=EXACT)
    assert image.depth[0, 32] == pytest.approx(FRONT_WALL / (np.cos(0.25) + off * np.sin(0.25)), abs=EXACT)


def test_arrays_look_into_the_reading(room: bubblesim.Simulation) -> None:
    scan = room.object("/Lidar").reading
    assert np.shares_memory(scan.ranges, scan.ranges)
    with pytest.raises(ValueError, match="read-only"):
        scan.ranges[0, 0] = 1


def test_arrays_outlive_all_else() -> None:
    ranges = bubblesim.Simulation("sensors").object("/Lidar").reading.ranges
    assert ranges[0, 270] == pytest.approx(LEFT_WALL, abs=EXACT)


def test_a_reading_stays_while_the_next_is_measured(room: bubblesim.Simulation) -> None:
    lidar = room.object("/RingLidar")
    first = lidar.reading
    before = first.ranges.copy()
    room.step(3)
    second = lidar.reading
    assert first.time == 0
    assert second.time >= 0.1
    np.testing.assert_array_equal(first.ranges, before)
    assert (second.ranges != before).any(), "its noise is another"


def test_noise_follows_from_the_seed() -> None:
    first, same, other = (bubblesim.Simulation("sensors", seed=seed).object("/RingLidar").reading for seed in (1, 1, 2))
    np.testing.assert_array_equal(first.ranges, same.ranges)
    assert (first.ranges != other.ranges).any()


def test_what_is_no_sensor_has_no_reading(room: bubblesim.Simulation) -> None:
    with pytest.raises(bubblesim.WrongObject, match="/Mast is a model, not a sensor"):
        _ = room.object("/Mast").reading


def test_an_imu_reads_in_its_own_frame(room: bubblesim.Simulation) -> None:
    room.step()
    reading = room.object("/Imu").reading
    assert isinstance(reading, bubblesim.ImuReading)
    np.testing.assert_allclose(reading.linear_acceleration, [0, 0, 9.8], atol=1e-9)
    np.testing.assert_allclose(reading.angular_velocity, 0, atol=1e-9)
    np.testing.assert_allclose(reading.orientation, [0, 0, np.sqrt(0.5), np.sqrt(0.5)], atol=1e-9)
