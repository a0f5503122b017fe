# SPDX-License-Identifier: BSD-3-Clause
"""`rosrun bubblesim messages`."""

import subprocess
import sys
from pathlib import Path

import pytest

from bubblesim import _core
from ros_support import REPOSITORY


def run(*arguments: str) -> subprocess.CompletedProcess[str]:
    """Run the program as rosrun starts it."""
    command = [sys.executable, str(REPOSITORY / "scripts" / "messages"), *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def rows(*arguments: str) -> dict[str, list[str]]:
    """Return name -> md5, state, file."""
    return {line.split()[0]: line.split()[1:] for line in run(*arguments).stdout.splitlines()}


def test_listed_types_come_with_md5_and_file() -> None:
    md5, state, file = rows("geometry_msgs/Twist")["geometry_msgs/Twist"]
    assert (md5, state) == ("9f195f881246fdfa2798d1d3eebca84a", "listed")
    assert Path(file).name == "Twist.msg"


def test_all_types_of_the_machine_are_shown() -> None:
    shown = rows()
    assert set(_core.messages.message_names()) < set(shown)
    assert shown["shape_msgs/Plane"][:2] == ["2c1b92ed8f31492f8e73f6a4a44ca796", "run-time"]


def test_services_are_shown_apart() -> None:
    shown = rows("--services")
    assert shown["std_srvs/SetBool"][:2] == ["09fb03525b03e7ea1fd3992bafd87e16", "listed"]
    assert "std_msgs/Bool" not in shown


@pytest.mark.parametrize("pattern", ["posewith", "*/PoseWith*", "geometry_msgs/PoseW"])
def test_patterns_choose(pattern: str) -> None:
    names = {
        "PoseWithCovariance",
        "PoseWithCovarianceStamped",
    }
    assert set(rows(pattern)) == {f"geometry_msgs/{name}" for name in names}


def test_a_pattern_without_a_match_has_a_hint() -> None:
    result = run("Twits")
    assert (result.returncode, result.stdout) == (1, "")
    assert result.stderr == "error: no type matches 'Twits'; did you mean geometry_msgs/Twist?\n"


def test_a_changed_definition_is_called_outdated(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "share" / "std_msgs" / "msg").mkdir(parents=True)
    (tmp_path / "share" / "std_msgs" / "msg" / "Bool.msg").write_text("bool other\n")
    monkeypatch.setenv("CMAKE_PREFIX_PATH", str(tmp_path))
    assert rows("std_msgs/Bool")["std_msgs/Bool"][:2] == ["8b94c1b53db61fb6aed406028ad6332a", "outdated"]


def test_a_reader_may_leave_early() -> None:
    command = f"{sys.executable} {REPOSITORY}/scripts/messages | head -n 1"
    result = subprocess.run(["bash", "-c", command], capture_output=True, text=True, check=True)
    assert len(result.stdout.splitlines()) == 1
    assert result.stderr == ""
