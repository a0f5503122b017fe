# SPDX-License-Identifier: BSD-3-Clause
"""Launch files of robots, run with a master of their own; and what their topics carry."""

import os
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ros_support import DEADLINE, REPOSITORY, RosCore, start, stop_launch, wait_until

FOLDERS = [parent / "shared" / "robots" for parent in (REPOSITORY.parent, REPOSITORY.parent.parent)]
ROBOTS = next((folder for folder in FOLDERS if folder.is_dir()), None)
"""Packages of robots that others have published; they are not part of this repository."""


def with_packages(env: dict[str, str], *folders: Path, **more: str) -> dict[str, str]:
    """Return an environment in which ROS finds the packages in these folders first."""
    path = [*map(str, folders), *filter(None, env.get("ROS_PACKAGE_PATH", "").split(":"))]
    return {**env, "ROS_PACKAGE_PATH": ":".join(path), **more}


@contextmanager
def launched(core: RosCore, env: dict[str, str], log: Path, *arguments: str, ready: str) -> Iterator[Path]:
    """Run roslaunch until the end of the block, when a topic or service is there; yield the file of its output."""
    with log.open("w") as output:
        process = start(["roslaunch", *arguments], env, stdout=output, stderr=subprocess.STDOUT)
    try:

        def is_ready() -> bool:
            assert process.poll() is None, log.read_text()
            state = core.state()
            return ready in state["publishers"] or ready in state["services"]

        wait_until(is_ready, f"{ready}; {os.fspath(log)}", 3 * DEADLINE)
        yield log
    finally:
        stop_launch(process)
