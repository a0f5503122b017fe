# SPDX-License-Identifier: BSD-3-Clause
"""Names that no module has are marked in the editor while they are typed."""

from pathlib import Path

import pytest

from bubblesim.web.script_files import check_text
from bubblesim.web.script_names import unknown_names
from ros_support import REPOSITORY


@pytest.mark.parametrize(
    ("name", "text", "line"),
    [
        ("a.py", "def sysCall_init():\n    sim.getObjectPositon(1)\n", 2),
        ("a.lua", "function sysCall_init()\n  local x = 1\n  sim.getObjectPositon(1)\nend\n", 3),
    ],
)
def test_a_misspelt_function_is_marked_with_the_right_name(tmp_path: Path, name: str, text: str, line: int) -> None:
    (found,) = check_text(tmp_path / name, text)
    assert (found["line"], found["level"]) == (line, "warning")
    assert "getObjectPosition" in found["text"]


@pytest.mark.parametrize(
    "text",
    [
        "# sim.nothing\nx = 'sim.nothing'\ny = '''\nsim.nothing'''\n",
        "sim.mine = 3\nprint(sim.mine)\n",
        "self.sim.nothing()\n",
        "sim = require('sim-2')\nsim.Object('/a')\n",
    ],
)
def test_strings_comments_and_names_of_the_script_are_not_marked(text: str) -> None:
    assert unknown_names(text, lua=False) == []


def test_comments_of_lua_are_not_marked() -> None:
    assert unknown_names("--[[ sim.nothing\n]] -- sim.nothing\nx = [[sim.nothing]] .. 'sim.nothing'\n", lua=True) == []


def test_old_names_are_known() -> None:
    assert unknown_names("sim.getObjectHandle('a')\n", lua=False) == []


@pytest.mark.parametrize("script", sorted((REPOSITORY / "scenes").glob("*.py")), ids=lambda file: file.name)
def test_the_scripts_of_the_scenes_have_no_unknown_names(script: Path) -> None:
    assert unknown_names(script.read_text(), lua=False) == []
