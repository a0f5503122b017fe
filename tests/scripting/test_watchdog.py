# SPDX-License-Identifier: BSD-3-Clause
"""A callback that does not return is reported with its current line; the simulator can still be ended."""

import re
import time
from pathlib import Path

import pytest

from node_support import Node, run_script, write
from ros_support import free_port, ros_environment

STUCK = {
    "script.py": "def sysCall_init(): pass\ndef sysCall_actuation():\n    n = 0\n    while True:\n        n += 1\n",
    "sleeping.py": "import time\ndef sysCall_init():\n    time.sleep(\n        1000)\n",
    "script.lua": "function sysCall_init()\n  local n = 0\n  while true do\n    n = n + 1\n  end\nend\n",
}
PLACES = {"script.py": "[45]", "sleeping.py": "3", "script.lua": "[34]"}


@pytest.mark.parametrize("name", STUCK)
def test_the_place_is_reported_and_the_node_ends_on_a_signal(tmp_path: Path, name: str) -> None:
    script = write(tmp_path / name, STUCK[name])
    environment = ros_environment(free_port(), tmp_path)
    with Node(environment, tmp_path / "log", "ball", "--no-ros", "--child-script", f"/Ball={script}") as node:
        node.wait_for_output("the simulation is waiting")
        place = re.search(
            r"child script of /Ball has not returned from (sysCall_\w+) for 1.5 s, now at (.*):(\d+): "
            "the simulation is waiting",
            node.output,
        )
        assert place is not None, node.output
        assert place[2] == str(script)
        assert re.fullmatch(PLACES[name], place[3])
        began = time.monotonic()
        assert node.end() == 0
        assert time.monotonic() - began < 10  # without force, which comes later
        assert "was interrupted in sysCall_" in node.output


def test_a_script_that_waits_for_a_master_with_rospy_is_named(tmp_path: Path) -> None:
    script = write(
        tmp_path / "script.py", "import rospy\ndef sysCall_init(): rospy.init_node('mine', disable_signals=True)\n"
    )
    port = free_port()
    with Node(
        ros_environment(port, tmp_path), tmp_path / "log", "ball", "--no-ros", f"--child-script=/Ball={script}"
    ) as node:
        node.wait_for_output("the simulation is waiting")
        uri = f"http://localhost:{port}"
        assert f"; rospy waits for the ROS master at {uri}, which does not answer: start roscore" in node.output
        assert node.end() == 0


def test_a_callback_is_reported_once(tmp_path: Path) -> None:
    code = "import time\ndef sysCall_init(): time.sleep(4.5)\n"
    run = run_script(tmp_path, code, slowness=True)
    assert run.returncode == 0
    assert run.stderr.count("the simulation is waiting") == 1


def test_callbacks_that_return_are_not_reported(tmp_path: Path) -> None:
    code = """
        import time
        def sysCall_init(): pass
        def sysCall_actuation():
            begin = time.monotonic()
            time.sleep(0.5)
            print(time.monotonic() - begin)
    """
    run = run_script(tmp_path, code, until=0.3, slowness=True)
    longest = max(float(line) for line in run.stdout.splitlines())
    assert run.stderr == "" or longest > 1.4, f"reported although none took longer than {longest} s"  # busy machine
