# SPDX-License-Identifier: BSD-3-Clause
"""The script that follows the pages for newcomers finds what they say; the day itself takes minutes."""

import subprocess
import sys
from pathlib import Path

import pytest

from ros_support import REPOSITORY

sys.path.insert(0, str(Path(__file__).parent))

from follow import BLOCK, commands_of, file_name, follow


def test_commands_of_a_page_are_those_with_a_prompt() -> None:
    assert list(commands_of("console", "$ a --b\noutput\n$ scripts/demo\n$ source x\n$ c\n")) == ["a --b", "c"]
    assert list(commands_of("bash", "a\nb\n")) == ["a\nb"]
    assert list(commands_of("python", "a\n")) == []


@pytest.mark.parametrize(
    ("name", "saved"),
    [("README.md", "height.py"), ("docs/tutorials/ball.md", "mine.py"), ("docs/tutorials/first_robot.md", "first.sdf")],
)
def test_files_that_a_page_wants_are_saved(name: str, saved: str) -> None:
    page = (REPOSITORY / name).read_text()
    blocks = [block for block in BLOCK.finditer(page) if block[1] in ("python", "xml")]
    assert saved in [file_name(page, block.start(), block.end()) for block in blocks]


def test_a_command_that_fails_is_reported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "page.md").write_text("```console\n$ true\n$ echo seen; false\n```\n")
    monkeypatch.setattr("follow.REPOSITORY", tmp_path)
    (failure,) = follow("page.md", tmp_path, ":")
    assert failure == "page.md: echo seen; false\nseen\n"


def test_a_new_terminal_reads_no_arguments_of_a_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "setup.bash").write_text("[[ $# -eq 0 ]] || exit 1\n")
    (tmp_path / "page.md").write_text("```bash\ntrue --help\n```\n")
    monkeypatch.setattr("follow.REPOSITORY", tmp_path)
    assert follow("page.md", tmp_path, f"source {tmp_path}/setup.bash") == []


@pytest.mark.parametrize("arguments", [["--bogus"], ["a", "b"]])
def test_bad_usage_is_explained(arguments: list[str]) -> None:
    run = subprocess.run(
        [REPOSITORY / "scripts" / "first_day", *arguments], capture_output=True, text=True, check=False
    )
    assert (run.returncode, run.stderr[:6]) == (2, "usage:")
