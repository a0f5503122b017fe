# SPDX-License-Identifier: BSD-3-Clause
"""Scripts that do not return cannot keep the node from ending in time."""

import signal
import time
from pathlib import Path

import pytest

from node_support import NAME, Node, write
from ros_support import RosCore

LIMIT = 2.0
SLACK = 0.5
"""What ending a process may add on a busy machine."""


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("hook", ["sysCall_init", "sysCall_actuation", "sysCall_sensing"])
@pytest.mark.parametrize("busy", ["time.sleep(60)", "while True: pass"], ids=["sleeping", "looping"])
def test_a_script_that_does_not_return_is_broken_off(
    roscore: RosCore, tmp_path: Path, busy: str, hook: str, number: signal.Signals
) -> None:
    code = f"""
        import time
        def sysCall_init(): simROS.advertise('/out', 'std_msgs/Empty')
        def sysCall_cleanup(): print('cleanup')
        def {hook}():
            print('begun')
            {busy}
    """
    script = write(tmp_path / "script.py", code)
    with Node(roscore.env, tmp_path / "log", "ball", "--child-script", f"/Ball={script}") as node:
        node.wait_for_output("begun")
        node.wait_until_listed(roscore)
        begin = time.monotonic()
        assert node.end(number) == 0
        assert time.monotonic() - begin < LIMIT + SLACK
        assert f"warning: child script of /Ball was broken off in {hook} ({script}:" in node.output
        assert node.output.endswith("cleanup\n")
        assert NAME not in roscore.nodes()


def test_a_script_that_python_cannot_break_off_is_left_behind(roscore: RosCore, tmp_path: Path) -> None:
    code = """
        import itertools
        def sysCall_init():
            print('begun')
            sum(itertools.repeat(0))  # endless, in C
    """
    script = write(tmp_path / "script.py", code)
    with Node(roscore.env, tmp_path / "log", "ball", "--child-script", f"/Ball={script}") as node:
        node.wait_for_output("begun")
        node.wait_until_listed(roscore)
        begin = time.monotonic()
        assert node.end(signal.SIGTERM) == -signal.SIGTERM
        assert time.monotonic() - begin < LIMIT + SLACK
        assert "error: a script does not return" in node.output
        assert NAME not in roscore.nodes()
