# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim new-plugin; tests/gazebo_plugins/test_own_plugins.py builds and runs what it writes."""

from pathlib import Path

import pytest

from cli_support import bubblesim


@pytest.mark.parametrize("name", ["", "Mine", "1st", "my plugin", "../up", "a-b"])
def test_names_that_are_none_are_refused(tmp_path: Path, name: str) -> None:
    run = bubblesim("new-plugin", name, "--cpp", cwd=tmp_path)
    assert run.returncode == 2
    assert f"'{name}' is not a valid package name" in run.stderr
    assert ("its folder is given by --folder" in run.stderr) == ("/" in name)
    assert list(tmp_path.iterdir()) == []


def test_nothing_is_overwritten(tmp_path: Path) -> None:
    (tmp_path / "mine").mkdir()
    run = bubblesim("new-plugin", "mine", "--python", cwd=tmp_path)
    assert run.returncode == 2
    assert "mine already exists" in run.stderr
    assert list((tmp_path / "mine").iterdir()) == []


def test_the_language_is_asked_for(tmp_path: Path) -> None:
    run = bubblesim("new-plugin", "mine", cwd=tmp_path)
    assert run.returncode == 2
    assert "--cpp --python is required" in run.stderr


def test_classes_and_files_have_the_name_of_the_package(tmp_path: Path) -> None:
    made = bubblesim("new-plugin", "my_thruster", "--cpp", "--folder", tmp_path)
    files = [Path(line) for line in made.stdout.splitlines()]
    assert files == [tmp_path / "my_thruster" / name for name in (
        "package.xml", "CMakeLists.txt", "plugins.xml", "src/plugin.cpp", "models/my_thruster.sdf",
        "test/test_my_thruster.py",
    )]  # fmt: skip
    written = "".join(file.read_text() for file in files)
    assert "PLUGINLIB_EXPORT_CLASS(my_thruster::MyThruster, bubblesim::PluginDevice)" in written
    assert 'filename="libmy_thruster.so"' in written
    assert "@" not in written.replace("me@example.org", "")
