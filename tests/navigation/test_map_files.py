# SPDX-License-Identifier: BSD-3-Clause
"""Maps in files, by the rules in ROS's map_server documentation."""

from pathlib import Path

import cv2
import numpy as np
import pytest

from bubblesim.navigation.map_files import MapFileError, read_map

SHADES = np.array([[0, 88, 90], [205, 206, 254]], dtype=np.uint8)  # top row first


def write(folder: Path, shades: np.ndarray = SHADES, picture: str = "room.pgm", **changes: object) -> Path:
    values: dict[str, object] = {
        "image": picture,
        "resolution": 0.1,
        "origin": [-1.0, 2.0, 0.5],
        "negate": 0,
        "occupied_thresh": 0.65,
        "free_thresh": 0.196,
    }
    values |= changes
    cv2.imwrite(str(folder / picture), shades)
    file = folder / "room.yaml"
    file.write_text("".join(f"{name}: {value}\n" for name, value in values.items() if value is not None))
    return file


def test_dark_is_a_wall_white_is_free_and_the_lower_row_comes_first(tmp_path: Path) -> None:
    grid = read_map(write(tmp_path))
    # 88 is 0.6549 occupied, 90 is 0.647, 205 is 0.19608, 206 is 0.192.
    assert grid.cells.tolist() == [[-1, 0, 0], [100, 100, -1]]
    assert (grid.resolution, grid.origin) == (0.1, (-1.0, 2.0, 0.5))


def test_negate_swaps_dark_and_bright(tmp_path: Path) -> None:
    assert read_map(write(tmp_path, negate=1)).cells.tolist() == [[100, 100, 100], [0, -1, -1]]


def test_scale_keeps_what_lies_between(tmp_path: Path) -> None:
    shades = np.array([[0, 127, 255]], dtype=np.uint8)
    grid = read_map(write(tmp_path, shades, mode="scale", occupied_thresh=0.9, free_thresh=0.1))
    assert grid.cells.tolist() == [[100, int(1 + 98 * (128 / 255 - 0.1) / 0.8), 0]]


def test_raw_takes_shades_as_they_are(tmp_path: Path) -> None:
    shades = np.array([[0, 50, 100, 101, 255]], dtype=np.uint8)
    assert read_map(write(tmp_path, shades, mode="raw")).cells.tolist() == [[0, 50, 100, -1, -1]]


def test_colours_are_averaged_and_the_transparent_is_unknown_in_scale(tmp_path: Path) -> None:
    pixels = np.zeros((1, 3, 4), dtype=np.uint8)
    pixels[0] = [[0, 0, 0, 255], [90, 120, 150, 255], [90, 120, 150, 0]]
    thresholds = {"occupied_thresh": 0.9, "free_thresh": 0.1}
    cells = read_map(write(tmp_path, pixels, "room.png", mode="scale", **thresholds)).cells
    assert cells[0, 0] == 100
    assert 0 < cells[0, 1] < 100
    assert cells[0, 2] == -1


@pytest.mark.parametrize(
    ("changes", "named"),
    [
        ({"image": "nowhere.pgm"}, "nowhere.pgm"),
        ({"resolution": 0}, "resolution"),
        ({"resolution": None}, "missing: resolution"),
        ({"origin": [1, 2]}, "origin"),
        ({"origin": "[.nan, 0, 0]"}, "origin"),
        ({"occupied_thresh": 0.1}, "free_thresh"),
        ({"mode": "colour"}, "trinary"),
        ({"negate": "perhaps"}, "perhaps"),
    ],
)
def test_what_is_no_map_is_reported(tmp_path: Path, changes: dict[str, object], named: str) -> None:
    with pytest.raises(MapFileError, match=named) as error:
        read_map(write(tmp_path, **changes))
    assert str(tmp_path / "room.yaml") in str(error.value)


@pytest.mark.parametrize("text", ["[1, 2", "just a word", "\x00"])
def test_what_is_no_yaml_is_reported(tmp_path: Path, text: str) -> None:
    file = tmp_path / "room.yaml"
    file.write_text(text)
    with pytest.raises(MapFileError, match=r"room\.yaml"):
        read_map(file)


def test_a_file_that_is_not_there_is_reported(tmp_path: Path) -> None:
    with pytest.raises(MapFileError, match=r"nowhere\.yaml"):
        read_map(tmp_path / "nowhere.yaml")
