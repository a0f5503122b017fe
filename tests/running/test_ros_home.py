# SPDX-License-Identifier: BSD-3-Clause
"""Where the home cannot be written, as on a live system, programs run all the same."""

import os
import subprocess
from pathlib import Path

import pytest

from ros_support import built, free_port

COMMANDS = {
    "demo": [str(built("bubblesim")), "demo", "tricycle", "--seconds", "8"],
    "run": [str(built("bubblesim")), "run", "ball", "--roscore", "--until", "0.5", "--speed", "max"],
    "node": [str(built("sim")), "ball", "--until", "0.5", "--speed", "max"],
    "window": [str(built("sim")), "ball", "--until", "0.5", "--web"],
}


@pytest.mark.parametrize("name", COMMANDS)
def test_a_home_that_cannot_be_written_is_named(tmp_path: Path, name: str) -> None:
    home = tmp_path / "home"
    home.mkdir()
    mount = f'mount -t tmpfs -o ro tmpfs {home}; exec "$@"'  # root may write where others may not
    read_only = ["unshare", "--map-root-user", "--mount", "bash", "-c", mount, "bash"]
    if subprocess.run([*read_only, "true"], check=False).returncode:
        pytest.skip("this user may not mount anything")
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    of_user = ("ROS_HOME", "ROS_LOG_DIR", "XDG_RUNTIME_DIR")
    environment = {name: value for name, value in os.environ.items() if name not in of_user}
    environment |= {"HOME": str(home), "ROS_MASTER_URI": f"http://localhost:{free_port()}", "TMPDIR": str(temporary)}
    run = subprocess.run(
        [*read_only, *COMMANDS[name]], env=environment, cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert run.returncode == 0, run.stdout + run.stderr
    (instead,) = temporary.glob("bubblesim*")  # one folder for all programs of a user
    info = f"info: {home}/.ros cannot be written (Read-only file system): ROS keeps its files in {instead}\n"
    assert info in run.stderr
    assert "Traceback" not in run.stdout + run.stderr
    assert "cannot be written to a file" not in run.stderr
