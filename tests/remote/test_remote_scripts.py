# SPDX-License-Identifier: BSD-3-Clause
"""Scripts, their problems and their messages as a program outside reads them, such as an editor."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import bubblesim
from node_support import Node, write
from ros_support import free_port, ros_environment, wait_until

GOOD = "def sysCall_init(): print('one')\ndef sysCall_sensing(): pass\n"


class Open(Node):
    """A node that serves remote clients, whose /Ball has a script in tmp_path, and a connection."""

    def __init__(self, folder: Path, code: str, *options: object, name: str = "script.py", start: bool = True) -> None:
        self.script = write(folder / name, code)
        self.port = free_port()
        how = ["--no-ros", f"--remote={self.port}", "--child-script", f"/Ball={self.script}", *options]
        super().__init__(ros_environment(free_port(), folder), folder / "log", "ball", *how)
        wait_until(lambda: "remote clients can connect" in self.output, "the remote API")
        self.connection = bubblesim.connect(self.port)
        self.sim: Any = self.connection.sim
        if start:
            self.sim.startSimulation()

    def problems(self) -> list[dict[str, Any]]:
        found: list[dict[str, Any]] = self.sim.getProblems()["problems"]
        return found


@pytest.fixture
def node(tmp_path: Path) -> Iterator[Open]:
    with Open(tmp_path, GOOD) as node:
        yield node
        node.connection.close()


def test_scripts_are_listed_and_readable(node: Open) -> None:
    found = node.sim.getScripts()
    handle = node.sim.getObject("/Ball")
    expected = {"handle": handle, "object": "/Ball", "file": str(node.script), "language": "python"}
    assert found == [expected | {"state": "running"}]
    assert node.sim.getScriptText(handle) == GOOD
    node.sim.stopSimulation()
    assert node.sim.getScripts() == [expected | {"state": "stopped"}]
    assert node.sim.getScriptText(handle) == GOOD
    assert node.sim.initScript(handle) is False
    with pytest.raises(RuntimeError, match="has no child script"):
        node.sim.getScriptText(node.sim.getObject("/Ball/link"))


def test_one_script_is_restarted_at_once_from_its_file(node: Open) -> None:
    handle = node.sim.getObject("/Ball")
    node.wait_for_output("one\n")
    before = node.sim.getSimulationTime()
    write(node.script, "def sysCall_init(): print('two')\ndef sysCall_cleanup(): print('end of two')\n")
    assert node.sim.initScript(handle) is True
    node.wait_for_output("two\n")
    assert node.sim.getSimulationTime() >= before  # the simulation goes on
    write(node.script, "def sysCall_init(:\n")
    assert node.sim.initScript(handle) is False
    assert "end of two" in node.output
    problem = node.problems()[-1]
    assert (problem["file"], problem["line"], problem["object"]) == (str(node.script), 1, "/Ball")
    assert "SyntaxError" in problem["text"]
    assert (problem["source"], problem["level"]) == ("script", "error")
    assert node.sim.getScripts()[0]["state"] == "failed"
    write(node.script, GOOD)
    assert node.sim.initScript(handle) is True
    assert node.problems() == []


@pytest.mark.parametrize(
    ("name", "code", "line", "text"),
    [
        ("script.py", "def sysCall_init():\n    pass\ndef sysCall_sensing():\n    nothing()\n", 4, "NameError"),
        ("script.lua", "function sysCall_init() end\nfunction sysCall_sensing()\n  nothing()\nend\n", 3, "nothing"),
        ("script.py", "def other(): pass\n", 0, "it defines neither sysCall_init"),
        ("script.lua", "function sysCall_init( end\n", 1, "expected"),
    ],
)
def test_errors_have_file_line_and_text(tmp_path: Path, name: str, code: str, line: int, text: str) -> None:
    with Open(tmp_path, code, name=name) as node:
        wait_until(lambda: bool(node.problems()), "the problem")
        (problem,) = node.problems()
        assert (problem["file"], problem["line"], problem["level"]) == (str(node.script), line, "error")
        assert text in problem["text"]
        revision = node.sim.getProblems()["revision"]
        entries = node.sim.getLog()["entries"]
        assert [each["object"] for each in entries if each["level"] == 420] == ["/Ball"]
        assert "disabled" in entries[-1]["text"]
        node.sim.stopSimulation()
        assert node.problems() == [problem]  # until the script is loaded again
        assert node.sim.getProblems()["revision"] == revision
        node.connection.close()


def test_warnings_of_the_scene_are_problems_too(tmp_path: Path) -> None:
    scene = write(
        tmp_path / "odd.sdf",
        """\
        <?xml version="1.0"?>
        <sdf version="1.9"><world name="odd"><model name="Box"><link name="link">
          <inertial><mass>1</mass></inertial>
          <nonsense>1</nonsense>
        </link></model></world></sdf>
        """,
    )
    port = free_port()
    with Node(ros_environment(free_port(), tmp_path), tmp_path / "log", scene, "--no-ros", f"--remote={port}") as node:
        wait_until(lambda: "remote clients can connect" in node.output, "the remote API")
        with bubblesim.connect(port) as simulator:
            found = simulator.sim.getProblems()["problems"]
        assert found, node.output
        assert {(each["source"], each["level"], each["file"]) for each in found} == {("scene", "warning", str(scene))}
        for each in found:
            assert f"{each['file']}:{each['line']}" in node.output
            assert each["text"] in node.output


def test_a_client_draws_and_records_like_a_script(node: Open) -> None:
    sim = node.sim
    drawing = sim.addDrawingObject(sim.drawing_points, 3, 0, -1, 100, None, None, None, [1, 0, 0])
    assert sim.addDrawingObjectItem(drawing, [1, 2, 3]) == 1
    (found,) = sim.getDrawings()["changed"]
    assert (found["handle"], len(found["items"])) == (drawing, 12)
    graph = sim.getObject("/Ball")
    stream = sim.addGraphStream(graph, "height", "m")
    sim.setGraphStreamValue(graph, stream, 2.5)
    wait_until(lambda: len(sim.getGraphCurve(graph, 0, 0)[4]) > 0, "a sample")
    assert list(sim.getGraphCurve(graph, 0, 0)[4]) == [2.5]
    sim.addLog(sim.verbosity_infos, "hello")
    assert sim.getLog()["entries"][-1]["object"] == "remote client 1"


def test_a_script_cannot_restart_scripts(tmp_path: Path) -> None:
    code = "def sysCall_init():\n    sim.initScript(sim.handle_self)\n"
    with Open(tmp_path, code) as node:
        node.wait_for_output("is for remote clients")
        node.connection.close()
