# SPDX-License-Identifier: BSD-3-Clause
"""bubblesim scenes."""

from pathlib import Path

from cli_support import bubblesim
from node_support import run_sim


def test_every_scene_is_listed_with_what_it_is() -> None:
    run = bubblesim("scenes")
    assert (run.returncode, run.stderr) == (0, "")
    lines = dict(line.split(maxsplit=1) for line in run.stdout.splitlines())
    assert list(lines) == run_sim("--list-scenes").stdout.split()
    assert lines["ball"].startswith("A ball that rolls down a ramp")
    assert all(not summary.startswith("<") for summary in lines.values())


def test_scenes_of_ones_own_come_first(tmp_path: Path) -> None:
    (tmp_path / "ball.sdf").write_text("<!-- Mine. It rolls. -->\n<sdf/>\n")
    run = bubblesim("scenes", BUBBLESIM_SCENE_PATH=str(tmp_path))
    assert next(line for line in run.stdout.splitlines() if line.startswith("ball ")).endswith(" Mine")
