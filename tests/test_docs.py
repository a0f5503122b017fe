# SPDX-License-Identifier: BSD-3-Clause
"""The commands in the documentation work: its bash and python blocks run, its links exist.

A page that needs a simulator has a comment, <!-- in another terminal: COMMAND -->, with a topic, a service or an
address HOST:PORT if its scene has no /tf: <!-- in another terminal: COMMAND, until there is TOPIC -->. Blocks marked
console are for the reader only. Python blocks that are parts of a child script run as one script on the pages in
SCRIPTS_RUN, those of ROS nodes next to the simulator.
"""

import contextlib
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from node_support import run_script, run_sim, without_slowness, write
from ros_support import (
    DEADLINE,
    REPOSITORY,
    RosCore,
    alone_on_port,
    is_served,
    start,
    stop,
    stop_launch,
    wait_until,
)

PAGES = sorted([*REPOSITORY.glob("*.md"), *REPOSITORY.glob("wheel/*.md"), *(REPOSITORY / "docs").rglob("*.md")])
BLOCK = re.compile(r"^```(bash|lua|python)\n(.*?)^```", re.MULTILINE | re.DOTALL)
OTHER_TERMINAL = re.compile(r"<!-- in another terminal: (.+?)(?:, until there is (\S+))? -->")
LINK = re.compile(r"\]\((?!https?:)([^)#]*)(?:#([^)]*))?\)")
HEADING = re.compile(r"^#+ (.+)$", re.MULTILINE)
CHILD_SCRIPT = "sysCall_"  # part of a child script: not a program
ROS_NODE = "import rospy"
NODE_NAME = re.compile(r'rospy\.init_node\("(\w+)"')
ENDPOINT = re.compile(r'rospy\.(Publisher|Subscriber)\("(\S+)"')
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
    expected = command[2] or "/tf"
    _, is_address, port = expected.partition(":")
    with alone_on_port(int(port)) if is_address else contextlib.nullcontext():
        process = start(command[1].split(), roscore.env, stdout=subprocess.DEVNULL)
        try:
            # Long, because roslaunch starts several programs one after the other.
            wait_until(lambda: is_there(expected, roscore), expected, timeout=3 * DEADLINE)
            yield roscore
        finally:
            stop_launch(process)


def is_there(expected: str, roscore: RosCore) -> bool:
    """Return whether a topic is advertised, a service offered or an address HOST:PORT served."""
    if ":" not in expected:
        state = roscore.state()
        return expected in state["publishers"] or expected in state["services"]
    return is_served(f"http://{expected}/")


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


def is_registered(code: str, roscore: RosCore) -> bool:
    """Return whether the master knows all publishers and subscribers of a node."""
    name, endpoints, state = NODE_NAME.search(code), ENDPOINT.findall(code), roscore.state()
    assert name
    assert endpoints
    return all(f"/{name[1]}" in state[f"{kind.lower()}s"].get(topic, []) for kind, topic in endpoints)


WITH_NODES = [page for page in PAGES if any(is_node(*block) for block in BLOCK.findall(page.read_text()))]


@pytest.mark.parametrize(("simulator", "page"), [(page, page) for page in WITH_NODES], indirect=["simulator"], ids=name)
def test_nodes_run_until_they_are_ended(simulator: RosCore, page: Path, tmp_path: Path) -> None:
    for language, code in BLOCK.findall(page.read_text()):
        if is_node(language, code):
            log = tmp_path / "log"
            with log.open("w") as output:
                command = ["/usr/bin/python3", str(write(tmp_path / "node.py", code))]
                node = start(command, simulator.env, stdout=output, stderr=output)
            try:
                # A signal during a call of the master would block rospy forever.
                wait_until(lambda code=code: is_registered(code, simulator), f"the topics of the node\n{code}")
                time.sleep(3.0)  # it works, or fails
                assert node.poll() is None, f"{code}\n{log.read_text()}"
                node.send_signal(signal.SIGINT)
                node.wait(timeout=2 * DEADLINE)
            finally:
                stop(node)
            assert "Error" not in log.read_text(), f"{code}\n{log.read_text()}"


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
        warned = "warning" in without_slowness(run.stderr)
        assert (run.returncode, warned) == (0, False), f"{code}\n{run.stderr}"


def has_anchor(target: Path, anchor: str) -> bool:
    """Return whether a file exists and has a heading of which GitHub makes this anchor; any file has the empty one."""
    if not target.exists():
        return False
    headings = HEADING.findall(target.read_text()) if anchor else []
    return not anchor or anchor in [re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings]


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_links_lead_somewhere(page: Path) -> None:
    broken = [
        f"{target}#{anchor}"
        for target, anchor in LINK.findall(page.read_text())
        if not has_anchor(page.parent / target if target else page, anchor)
    ]
    assert broken == []
