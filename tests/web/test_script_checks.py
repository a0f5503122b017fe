# SPDX-License-Identifier: BSD-3-Clause
"""What the editor is reported about a string before it is saved."""

import sys
from pathlib import Path

import pytest

from bubblesim.web.script_files import check_text


@pytest.mark.parametrize(
    ("name", "text", "line", "part"),
    [
        ("a.py", "def sysCall_init():\n    x = = 1\n", 2, "SyntaxError"),
        ("a.py", "#python\n\nif True:\npass\n", 4, "IndentationError"),
        ("a.lua", "function sysCall_init()\n  x = \nend\n", 3, "unexpected"),
        ("a.py", "#lua\nfunction f( end\n", 2, "expected"),
    ],
)
def test_errors_have_their_line(tmp_path: Path, name: str, text: str, line: int, part: str) -> None:
    (found,) = check_text(tmp_path / name, text)
    assert found["line"] == line
    assert part in found["text"]


def test_nothing_of_the_text_runs(tmp_path: Path) -> None:
    target = tmp_path / "made"
    text = f"open({str(target)!r}, 'w')\nraise SystemExit\n"
    before = set(sys.modules)
    assert check_text(tmp_path / "a.py", text) == []
    assert check_text(tmp_path / "a.lua", "error('no')\n") == []
    assert not target.exists()
    assert "checked_script" not in set(sys.modules) - before


def test_included_files_of_the_scripts_folder_are_checked_too(tmp_path: Path) -> None:
    (tmp_path / "part.py").write_text("x = = 1\n")
    (found,) = check_text(tmp_path / "a.py", "#python\ninclude part\n\ndef sysCall_init(): pass\n")
    assert found["line"] == 1
    assert "part.py:1" in found["text"]
    assert check_text(tmp_path / "a.py", "#python\ninclude of_another_folder\n\n") == []
