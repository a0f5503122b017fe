# SPDX-License-Identifier: BSD-3-Clause
"""An edited script is reloaded: at the next start, and with --watch at once."""

from pathlib import Path

import pytest

from node_support import Node, write
from ros_support import free_port, ros_environment


@pytest.mark.parametrize(
    ("name", "code"),
    [
        ("script.py", "def sysCall_init(): print('{}')\ndef sysCall_cleanup(): print('end of {}')\n"),
        ("script.lua", "function sysCall_init() print('{}') end\nfunction sysCall_cleanup() print('end of {}') end\n"),
    ],
)
def test_an_edited_script_starts_again(tmp_path: Path, name: str, code: str) -> None:
    script = write(tmp_path / name, code.format("one", "one"))
    options = ["ball", "--no-ros", "--watch", "--child-script", f"/Ball={script}"]
    with Node(ros_environment(free_port(), tmp_path), tmp_path / "log", *options) as node:
        node.wait_for_output("one\n")
        write(script, "no code at all (\n")
        node.wait_for_output("is disabled")
        write(script, code.format("two", "two"))
        node.wait_for_output("two\n")
        assert node.end() == 0
        assert "end of one\ninfo" not in node.output
        assert node.output.index("end of one") < node.output.index("two\n") < node.output.index("end of two")
        assert "info: the child script of /Ball has changed: restarting it\n" in node.output


def test_so_does_one_whose_included_file_was_edited(tmp_path: Path) -> None:
    part = write(tmp_path / "part.py", "WORD = 'one'\n")
    script = write(tmp_path / "script.py", "#python\ninclude part\n\ndef sysCall_init(): print(WORD)\n")
    options = ["ball", "--no-ros", "--watch", "--child-script", f"/Ball={script}"]
    with Node(ros_environment(free_port(), tmp_path), tmp_path / "log", *options) as node:
        node.wait_for_output("one\n")
        write(part, "WORD = 'three'\n")
        node.wait_for_output("three\n")


def test_an_edit_while_the_script_is_loaded_is_not_missed(tmp_path: Path) -> None:
    part = write(tmp_path / "part.py", "WORD = 'one'\n")
    edit = f"if WORD == 'one': open({str(part)!r}, 'w').write(\"WORD = 'three'\\n\")\n"
    script = write(tmp_path / "script.py", f"#python\ninclude part\n\n{edit}def sysCall_init(): print(WORD)\n")
    options = ["ball", "--no-ros", "--watch", "--child-script", f"/Ball={script}"]
    with Node(ros_environment(free_port(), tmp_path), tmp_path / "log", *options) as node:
        node.wait_for_output("three\n")


def test_without_the_option_it_is_the_next_start_that_loads_it(tmp_path: Path) -> None:
    other = tmp_path / "script.py"
    code = f"""
        def sysCall_init(): print('old')
        def sysCall_sensing():
            if sim.getSimulationTime() == 0: return
            open({str(other)!r}, 'w').write("def sysCall_init(): print('new'); sim.quitSimulator()")
            sim.stopSimulation()
            sim.startSimulation()
    """
    script = write(other, code)
    options = ["ball", "--child-script", f"/Ball={script}"]
    with Node(ros_environment(free_port(), tmp_path), tmp_path / "log", *options) as node:
        assert node.process.wait(timeout=30) == 0
        assert [line for line in node.output.splitlines() if line in ("old", "new")] == ["old", "new"]
