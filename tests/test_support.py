# SPDX-License-Identifier: BSD-3-Clause
"""The helpers of the tests, where a mistake would show up as a failure of another test."""

from pathlib import Path

from node_support import endless_fall, run_sim
from ros_support import RosCore


def test_a_roscore_that_has_learnt_a_type_is_not_given_to_the_next_test(roscore: RosCore) -> None:
    assert roscore.is_as_new()
    roscore.run("rostopic", "pub", "-1", "/t", "std_msgs/UInt8", "data: 1")
    assert roscore.nodes() == {"/rosout"}
    assert not roscore.is_as_new()


def test_a_roscore_leaves_nothing_in_the_home_folder(tmp_path: Path) -> None:
    with RosCore(tmp_path) as core:
        file = Path.home() / ".ros" / f"roscore-{core.port}.pid"
        assert not file.exists() or file.read_text().strip() != str(core.process.pid)


def test_a_simulation_that_diverged_leaves_nothing_in_the_folder_of_all_users(tmp_path: Path) -> None:
    before = set(Path("/tmp").glob("bubblesim_diverged_*"))
    run = run_sim(endless_fall(tmp_path), "--no-ros", "--speed", "max", "--until", "5")
    assert "bubblesim_diverged_" in run.stderr
    written = {file for file in Path("/tmp").glob("bubblesim_diverged_*") if str(file) in run.stderr}
    assert not written - before
