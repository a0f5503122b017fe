# SPDX-License-Identifier: BSD-3-Clause
from pathlib import Path

import pytest

from bubblesim.messages.lists import add_to_list

LIST = "# a list\n\nstd_msgs/Bool\nstd_msgs/String  # text\n\nnav_msgs/Path\n"


@pytest.mark.parametrize(
    ("name", "after"),
    [
        ("std_msgs/Char", "std_msgs/Bool"),
        ("std_msgs/UInt8", "std_msgs/String  # text"),
        ("std_msgs/Aaa", ""),
        ("nav_msgs/Odometry", ""),
        ("nav_msgs/Zzz", "nav_msgs/Path"),
    ],
)
def test_types_are_sorted_among_those_of_their_package(tmp_path: Path, name: str, after: str) -> None:
    path = tmp_path / "messages.txt"
    path.write_text(LIST)
    add_to_list(path, name)
    lines = path.read_text().splitlines()
    assert lines[lines.index(name) - 1] == after
    assert [line for line in lines if line != name] == LIST.splitlines()


def test_a_new_package_becomes_a_block_of_its_own(tmp_path: Path) -> None:
    path = tmp_path / "messages.txt"
    path.write_text(LIST)
    assert add_to_list(path, "my_robot/Cell") == f"my_robot/Cell: listed at {path}:8"
    assert path.read_text() == LIST + "\nmy_robot/Cell\n"


def test_a_listed_type_is_not_listed_again(tmp_path: Path) -> None:
    path = tmp_path / "messages.txt"
    path.write_text(LIST.replace("nav_msgs/Path", "nav_msgs/msg/Path"))
    assert add_to_list(path, "nav_msgs/Path") == f"nav_msgs/Path: already listed at {path}:6"
    assert "nav_msgs/Path" not in path.read_text()


def test_a_last_line_without_an_end_gets_one(tmp_path: Path) -> None:
    path = tmp_path / "messages.txt"
    path.write_text("std_msgs/Bool")
    add_to_list(path, "std_msgs/Char")
    assert path.read_text() == "std_msgs/Bool\nstd_msgs/Char\n"
