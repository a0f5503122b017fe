# SPDX-License-Identifier: BSD-3-Clause
"""Messages of actions are found without catkin's generated files, as genaction.py writes them."""

import subprocess
import sys
from pathlib import Path

import pytest

from bubblesim.messages.action_messages import action_of
from bubblesim.messages.packages import PackageIndex
from ros_support import REPOSITORY

GENACTION = Path("/usr/lib/actionlib_msgs/genaction.py")
FILES = sorted(REPOSITORY.glob("msg/*/action/*.action"))


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_all_seven_are_those_of_genaction(file: Path, tmp_path: Path) -> None:
    subprocess.run([sys.executable, GENACTION, file, "-o", tmp_path], check=True, stdout=subprocess.DEVNULL)
    written = sorted(tmp_path.iterdir())
    assert len(written) == 7
    for message in written:
        assert action_of(message.stem, file.parent) == (message.read_text(), file)


@pytest.mark.parametrize("text", ["int32 order\n", "---\n", "---\n---\n---\n"], ids=["one", "two", "four"])
def test_a_file_without_three_parts_has_none(text: str, tmp_path: Path) -> None:
    (tmp_path / "Fibonacci.action").write_text(text)
    assert action_of("FibonacciGoal", tmp_path) is None


def test_the_index_finds_them_where_the_action_is(tmp_path: Path) -> None:
    (tmp_path / "action").mkdir()
    (tmp_path / "action" / "Fibonacci.action").write_text("int32 order\n---\n---\n")
    index = PackageIndex({"tutorial": [tmp_path]})
    found = index.find("tutorial/FibonacciActionGoal", "msg")
    assert found is not None
    assert found.file == tmp_path / "action" / "Fibonacci.action"
    assert "FibonacciGoal goal\n" in found.text
    assert index.find("tutorial/FibonacciActionGoals", "msg") is None


def test_a_message_of_its_own_comes_first(tmp_path: Path) -> None:
    for file, text in {"action/Go.action": "---\n---\n", "msg/GoGoal.msg": "float64 distance\n"}.items():
        (tmp_path / file).parent.mkdir()
        (tmp_path / file).write_text(text)
    found = PackageIndex({"tutorial": [tmp_path]}).find("tutorial/GoGoal", "msg")
    assert found is not None
    assert found.text == "float64 distance\n"
