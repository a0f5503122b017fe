# SPDX-License-Identifier: BSD-3-Clause
"""The nodes of src/nodes as processes, and their peers."""

import json
import subprocess
import textwrap
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from node_types import Ask, Start
from ros_support import REPOSITORY, RosCore, built, start, stop

PREAMBLE = """
import json, math, sys, time
import numpy as np
import rospy, tf2_ros
from geometry_msgs.msg import *
from nav_msgs.msg import *
from sensor_msgs.msg import *

def wait_until(condition, what):
    end = time.monotonic() + 60
    while not condition():
        if time.monotonic() > end: sys.exit(f"waited in vain for {what}")
        time.sleep(0.02)

rospy.init_node("peer", anonymous=True)
"""


@pytest.fixture(scope="module")
def core(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RosCore]:
    """A master for all tests of a module, which use different names."""
    with RosCore(tmp_path_factory.mktemp("roslog")) as core:
        yield core


@pytest.fixture
def node(core: RosCore) -> Iterator[Start]:
    """Start one of our nodes, built or from scripts/, which ends with the test."""
    processes = []

    def begin(name: str, *arguments: object, **options: Any) -> "subprocess.Popen[str]":
        script = REPOSITORY / "scripts" / name
        command = ["/usr/bin/python3", str(script)] if script.exists() else [str(built(name))]
        processes.append(start([*command, *map(str, arguments)], core.env, **options))
        return processes[-1]

    yield begin
    for process in processes:
        stop(process)


@pytest.fixture
def ask(core: RosCore, tmp_path: Path) -> Ask:
    """Run rospy code in its own process, and return the JSON of its last output line."""

    def run(code: str, *arguments: object) -> Any:
        file = tmp_path / "peer.py"
        file.write_text(PREAMBLE + textwrap.dedent(code), encoding="utf-8")
        command = ["/usr/bin/python3", str(file), *map(str, arguments)]
        done = subprocess.run(command, env=core.env, capture_output=True, text=True, timeout=120, check=False)
        assert done.returncode == 0, done.stdout + done.stderr
        return json.loads(done.stdout.splitlines()[-1])

    return run
