# SPDX-License-Identifier: BSD-3-Clause
"""The commands in the documentation work: its bash and python blocks run, its links exist.

A page that needs a simulator has a comment, <!-- in another terminal: COMMAND -->, with a topic if its scene has no
/tf: <!-- in another terminal: COMMAND, until there is TOPIC -->. Blocks marked console are for the reader only. Python
blocks that are parts of a child script run as one script on the pages in SCRIPTS_RUN, those of ROS nodes next to the
simulator.
"""

import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from node_support import run_script, run_sim, write
from ros_support import REPOSITORY, RosCore, start, stop, wait_until

PAGES = sorted([*REPOSITORY.glob("*.md"), *(REPOSITORY / "docs").rglob("*.md")])
BLOCK = re.compile(r"^```(bash|lua|python)\n(.*?)^```", re.MULTILINE | re.DOTALL)
OTHER_TERMINAL = re.compile(r"<!-- in another terminal: (.+?)(?:, until there is (\S+))? -->")
LINK = re.compile(r"\]\((?!https?:)([^)#]+)")
CHILD_SCRIPT = "sysCall_"  # part of a child script: not a program
ROS_NODE = "import rospy"
SCRIPTS_RUN = re.compile(r"<!-- the child scripts of this page run by themselves(?: in (\w+) for (\S+))? -->")

PYTHON_ENDS_ALONE = [
    (page, code)
    for page in PAGES
    for language, code in BLOCK.findall(page.read_text())
    if language == "python" and CHILD_SCRIPT not in code and ROS_NODE not in code
]
WITH_BASH = [page for page in PAGES if any(language == "bash" for language, _ in BLOCK.findall(page.read_text()))]


IN_LUA = [(page, code) for page in PAGES for language, code in BLOCK.findall(page.read_text()) if language == "lua"]


def name(page: Path) -> str:
    return str(page.relative_to(REPOSITORY))


@pytest.fixture
def simulator(request: pytest.FixtureRequest, roscore: RosCore) -> Iterator[RosCore]:
    """Run the command that the page runs in another terminal; return the master."""
    command = OTHER_TERMINAL.search(request.param.read_text())
    assert command, "a page with bash blocks names what runs meanwhile"
    process = start(command[1].split(), roscore.env, stdout=subprocess.DEVNULL)
    wait_until(lambda: (command[2] or "/tf") in roscore.state()["publishers"], "the simulation's topics")
    yield roscore
    stop(process)


@pytest.mark.parametrize(("simulator", "page"), [(page, page) for page in WITH_BASH], indirect=["simulator"], ids=name)
def test_bash_blocks_run(simulator: RosCore, page: Path) -> None:
    for language, code in BLOCK.findall(page.read_text()):
        if language == "bash":
            for command in code.splitlines() if "=$(" not in code else [code]:
                run = subprocess.run(
                    ["bash", "-eu", "-c", command],
                    env=simulator.env,
                    capture_output=True,
                    text=True,
                    timeout=60,
                    check=False,
                )
                assert run.returncode == 0, f"{command}\n{run.stdout}{run.stderr}"


def is_node(language: str, code: str) -> bool:
    return language == "python" and ROS_NODE in code


WITH_NODES = [page for page in PAGES if any(is_node(*block) for block in BLOCK.findall(page.read_text()))]


@pytest.mark.parametrize(("simulator", "page"), [(page, page) for page in WITH_NODES], indirect=["simulator"], ids=name)
def test_nodes_run_until_they_are_ended(simulator: RosCore, page: Path, tmp_path: Path) -> None:
    for language, code in BLOCK.findall(page.read_text()):
        if is_node(language, code):
            command = ["timeout", "--signal=INT", "5", "/usr/bin/python3", str(write(tmp_path / "node.py", code))]
            run = subprocess.run(command, env=simulator.env, capture_output=True, text=True, timeout=60, check=False)
            assert (run.returncode, "Error" in run.stderr) == (124, False), f"{code}\n{run.stdout}{run.stderr}"


@pytest.mark.parametrize(("page", "code"), PYTHON_ENDS_ALONE)
def test_python_blocks_run(page: Path, code: str) -> None:
    subprocess.run([sys.executable, "-c", code], cwd=REPOSITORY, check=True, timeout=60)


@pytest.mark.parametrize(("page", "code"), IN_LUA)
def test_lua_blocks_run(tmp_path: Path, page: Path, code: str) -> None:
    run = run_script(tmp_path, code, "--strict", name="script.lua")
    assert (run.stderr, run.returncode) == ("", 0)


@pytest.mark.parametrize("page", [page for page in PAGES if SCRIPTS_RUN.search(page.read_text())], ids=name)
def test_child_scripts_run(roscore: RosCore, tmp_path: Path, page: Path) -> None:
    reported = SCRIPTS_RUN.search(page.read_text())
    assert reported
    scene, model = reported[1] or "ball", reported[2] or "/Ball"
    scripts = [code for language, code in BLOCK.findall(page.read_text()) if language == "python"]
    scripts = [code for code in scripts if CHILD_SCRIPT in code]
    assert scripts
    for code in scripts:
        script = write(tmp_path / "script.py", code)
        run = run_sim(scene, "--strict", "--until", 0.5, "--child-script", f"{model}={script}", env=roscore.env)
        assert (run.returncode, "warning" in run.stderr) == (0, False), f"{code}\n{run.stderr}"


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_links_lead_somewhere(page: Path) -> None:
    broken = [link for link in LINK.findall(page.read_text()) if not (page.parent / link).exists()]
    assert broken == []
