# SPDX-License-Identifier: BSD-3-Clause
"""The helpers of the tests, where a mistake would show up as a failure of another test."""

import contextlib
import shutil
import signal
import subprocess
import sys
import threading
from pathlib import Path

from node_support import NAME, Node, endless_fall, run_sim
from ros_support import REPOSITORY, RosCore


def test_a_roscore_that_has_learnt_a_type_is_for_the_tests_of_one_file(roscore: RosCore) -> None:
    assert roscore.is_as_new()
    assert not roscore.has_types_of_tests()
    roscore.run("rostopic", "pub", "-1", "/t", "std_msgs/UInt8", "data: 1")
    assert roscore.nodes() == {"/rosout"}
    assert roscore.is_as_new()
    assert roscore.has_types_of_tests()


def test_echo_takes_the_type_of_now_and_not_that_of_a_test_before(roscore: RosCore) -> None:
    roscore.run("rostopic", "pub", "-1", "/t", "std_msgs/UInt8", "data: 1")
    late = threading.Timer(3.0, lambda: ended.enter_context(roscore.publishing("/t", "std_msgs/String", "new")))
    with contextlib.ExitStack() as ended:
        late.start()
        assert roscore.echo("/t") == 'data: "new"\n---\n'
        late.join()


def test_a_roscore_forgets_the_nodes_that_were_killed(roscore: RosCore, tmp_path: Path) -> None:
    with Node(roscore.env, tmp_path / "log", "ball") as node:
        node.wait_until_ready(roscore)
        roscore.forget_ended_nodes()
        assert NAME in roscore.nodes()
        node.end(signal.SIGKILL)
    assert not roscore.is_as_new()
    roscore.forget_ended_nodes()
    assert roscore.is_as_new()


def test_the_tests_are_collected_where_the_files_of_others_are_absent(tmp_path: Path) -> None:
    shutil.copytree(REPOSITORY / "tests", tmp_path / "tests", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(REPOSITORY / "pyproject.toml", tmp_path)
    command = [sys.executable, "-m", "pytest", "--collect-only", "-q", "-p", "no:cacheprovider", "tests/cli"]
    run = subprocess.run(command, cwd=tmp_path, text=True, stdout=subprocess.PIPE, check=False)
    assert run.returncode == 0, run.stdout


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
