# SPDX-License-Identifier: BSD-3-Clause
"""A node that cannot begin, at each part of its start: it ends with an error, and not by using what is gone."""

from collections.abc import Callable
from pathlib import Path

import pytest

from node_support import run_sim, write
from ros_support import RosCore, free_port


def not_a_state(folder: Path) -> list[str]:
    return ["--load-state", str(write(folder / "state", "not a state"))]


def not_a_script(folder: Path) -> list[str]:
    return ["--child-script", f"/Ball={folder / 'none.py'}"]


def not_a_folder(folder: Path) -> list[str]:
    return ["--record", str(folder / "none" / "bag.bag")]


def not_an_address(_folder: Path) -> list[str]:
    return ["--remote-address=192.0.2.1"]


@pytest.mark.parametrize("failure", [not_a_state, not_a_script, not_an_address])
@pytest.mark.parametrize("window", [[], ["--web"]])
def test_without_ros(tmp_path: Path, failure: Callable[[Path], list[str]], window: list[str]) -> None:
    run = run_sim("ball", "--no-ros", f"--remote={free_port()}", *failure(tmp_path), *window)
    assert run.returncode == 2, run.stderr
    assert "error: " in run.stderr
    assert "Traceback" not in run.stderr


@pytest.mark.parametrize("failure", [not_a_state, not_a_script, not_an_address, not_a_folder])
def test_with_ros(roscore: RosCore, tmp_path: Path, failure: Callable[[Path], list[str]]) -> None:
    run = run_sim("ball", f"--remote={free_port()}", *failure(tmp_path), env=roscore.env)
    assert run.returncode == 2, run.stderr
    assert "error: " in run.stderr
