# SPDX-License-Identifier: BSD-3-Clause
"""Names that no module has, and wrong calls, are marked in the editor while they are typed."""

from pathlib import Path

import pytest

from bubblesim.web.script_files import check_text
from bubblesim.web.script_names import warnings
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
    assert warnings(text, lua=False) == []


def test_comments_of_lua_are_not_marked() -> None:
    assert warnings("--[[ sim.nothing\n]] -- sim.nothing\nx = [[sim.nothing]] .. 'sim.nothing'\n", lua=True) == []


def test_old_names_are_known() -> None:
    assert warnings("sim.getObjectHandle('a')\n", lua=False) == []


@pytest.mark.parametrize("script", sorted((REPOSITORY / "scenes").glob("*.py")), ids=lambda file: file.name)
def test_the_scripts_of_the_scenes_have_no_warnings(script: Path) -> None:
    assert warnings(script.read_text(), lua=False) == []


@pytest.mark.parametrize(
    ("call", "reported"),
    [
        ("sim.setJointTargetVelocity(motor)", "(joint, velocity, motion): missing a required argument: 'velocity'"),
        ("sim.setJointTargetVelocity(motor,\n  f(1, 2), {}, [], 3)", "too many positional arguments"),
        ("sim.getObject()", "missing a required argument: 'path'"),
        ("sim.getObject('/a, b', {}, 3)", "too many positional arguments"),
    ],
)
def test_a_wrong_number_of_arguments_is_marked(call: str, reported: str) -> None:
    (found,) = warnings(f"x = 1\n{call}\n", lua=False)
    assert (found["line"], found["level"]) == (2, "warning")
    assert reported in found["text"]


@pytest.mark.parametrize(
    "call",
    [
        "sim.setJointTargetVelocity(*both)",
        "sim.setJointTargetVelocity(motor, velocity=3)",
        "sim.setJointTargetVelocity(motor, [1, 2, (3, 4)][0])",
        "sim.setJointTargetVelocity(motor, ",
        "sim.setObjectPosition(a, [1, 2, 3], b,)",
        "sim.getObject('(,,,)')",
    ],
)
def test_calls_that_may_be_right_are_not_marked(call: str) -> None:
    assert warnings(call, lua=False) == []


def test_calls_in_lua_may_have_more_arguments_and_end_with_several_values() -> None:
    (found,) = warnings("sim.setJointTargetVelocity(motor)\n", lua=True)
    assert "missing a required argument: 'velocity'" in found["text"]
    assert warnings("sim.setJointTargetVelocity(pair())\nsim.getObject('a', {}, 3)\nsim.wait(...)\n", lua=True) == []
