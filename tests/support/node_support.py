# SPDX-License-Identifier: BSD-3-Clause
"""The simulator's node, run by tests: to its end, or in the background."""

import json
import os
import re
import signal
import subprocess
import textwrap
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from ros_support import DEADLINE, RosCore, built, start, stop, wait_until

NAME = "/sim_ros_interface"
PREFIX = re.compile(r"^\[/\S+ [0-9.]+ s\] ", re.MULTILINE)
"""Prefix of the lines that scripts print: object and simulation time."""


def clean_environment(**changes: str) -> dict[str, str]:
    """Return the environment without variables of ROS or a workspace."""
    kept = {
        name: value
        for name, value in os.environ.items()
        if name == "ROS_HOME" or not name.startswith(("ROS", "PYTHON", "CMAKE", "BUBB"))
    }
    return kept | changes


def run_sim(
    *arguments: object,
    env: Mapping[str, str] | None = None,
    timeout: float = 3 * DEADLINE,
    prefixed: bool = False,
    within: Sequence[str] = (),
) -> "subprocess.CompletedProcess[str]":
    """Run the node until it ends by itself. Lines printed by scripts keep their prefix only if `prefixed`.

    ``within``: a program that runs the command which follows its arguments.
    """
    command = [*within, str(built("sim")), *map(str, arguments)]
    run = subprocess.run(command, env=env, capture_output=True, text=True, timeout=timeout, check=False)
    if not prefixed:
        run.stdout = PREFIX.sub("", run.stdout)
    return run


_SLOWNESS = re.compile(r"^warning: .* has not returned from .*\n", re.MULTILINE)


def without_slowness(text: str) -> str:
    """Remove the warnings about slow callbacks, which a busy machine causes."""
    return _SLOWNESS.sub("", text)


def run_script(
    folder: Path,
    code: str,
    *arguments: object,
    name: str = "script.py",
    scene: str = "ball",
    target: str = "/Ball",
    until: float = 0.2,
    prefixed: bool = False,
    slowness: bool = False,
) -> "subprocess.CompletedProcess[str]":
    """Run a child script in a scene without ROS, at full speed; the script is the file `name` in `folder`.

    Warnings about slow callbacks, which a busy machine causes, are removed from stderr unless `slowness` is set.
    """
    file = write(folder / name, code)
    options = ["--no-ros", "--speed", "max", "--until", until, "--child-script", f"{target}={file}"]
    run = run_sim(scene, *options, *arguments, prefixed=prefixed)
    if not slowness:
        run.stderr = without_slowness(run.stderr)
    return run


# For child scripts: the text of the error with which a call is refused, or of the warning that it has no effect.
REFUSED = """\
def refused(call, *arguments):
    try:
        call(*arguments)
    except (ValueError, LookupError, RuntimeError) as error:
        return str(error)
    raise AssertionError('accepted')


def warned(call, *arguments):
    sim.setStringParam(sim.stringparam_verbosity, 'errors')
    before = sim.getLog()['last']
    call(*arguments)
    sim.setStringParam(sim.stringparam_verbosity, 'infos')
    return ' '.join(entry['text'] for entry in sim.getLog(before)['entries'])
"""


def in_init(body: str) -> str:
    """Return sysCall_init of a child script with this body."""
    return "def sysCall_init():\n" + "".join(f"    {line}\n" for line in body.strip("\n").splitlines())


def write(file: Path, code: str) -> Path:
    file.write_text(textwrap.dedent(code), encoding="utf-8")
    return file


def endless_fall(folder: Path) -> Path:
    """Write a scene whose /Ball will diverge: it falls without a floor."""
    return write(
        folder / "fall.sdf",
        """\
        <?xml version="1.0"?>
        <sdf version="1.9">
          <world name="fall">
            <physics name="default" type="ode"><max_step_size>0.005</max_step_size></physics>
            <model name="Ball">
              <pose>0 0 -999999.5 0 0 0</pose>
              <link name="link">
                <inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial>
                <collision name="ball"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
              </link>
            </model>
          </world>
        </sdf>
        """,
    )


class Background:
    """A process in the background, which ends with the block."""

    process: "subprocess.Popen[str]"

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        stop(self.process)

    def wait_until_ready(self, core: RosCore, name: str = NAME) -> None:
        """Return when it offers services of the simulation. It is listed before it loads Python."""
        wait_until(lambda: f"{name}/get_object_state" in core.state()["services"], f"the services of {name}")


class Node(Background):
    """The node in the background; it ends with the block, and `output` holds what it wrote."""

    def __init__(self, env: dict[str, str], log: Path, *arguments: object, within: Sequence[str] = ()) -> None:
        """``within``: a program that runs the command which follows its arguments."""
        self._log = log
        command = [*within, str(built("sim")), *map(str, arguments)]
        with log.open("w") as output:
            self.process = start(command, env, stdout=output, stderr=subprocess.STDOUT)
        self._took = 0.0  # s to its end

    @property
    def output(self) -> str:
        return PREFIX.sub("", self._log.read_text(encoding="utf-8"))

    def wait_for_output(self, text: str, count: int = 1) -> None:
        wait_until(lambda: self.output.count(text) >= count, f"'{text}' in the output")

    def wait_until_listed(self, core: RosCore) -> None:
        wait_until(lambda: NAME in core.nodes(), "the node to be listed")

    def end(self, number: int = signal.SIGINT) -> int:
        """Send a signal to the node only and return its exit code."""
        begin = time.monotonic()
        self.process.send_signal(number)
        try:
            return self.process.wait(timeout=DEADLINE)
        finally:
            self._took = time.monotonic() - begin

    def has_unregistered(self, core: RosCore, blocked: float = 0.0) -> bool:
        """Return whether the master no longer lists it after its end.

        A busy master gets one second, after which the node ends without its answers.

        :param blocked: s for which a script kept the node before.
        """
        return NAME not in core.nodes() or self._took > blocked + 1.0


def findings_of(probe: str, env: dict[str, str], folder: Path) -> dict[str, Any]:
    """Return the JSON object that a probe, code of a Python node, prints at its end."""
    reported = folder / "reported"
    with reported.open("w") as output:
        process = start(["/usr/bin/python3", str(write(folder / "probe.py", probe))], env, stdout=output)
    try:
        wait_until(lambda: reported.read_text().endswith("}\n"), "what the probe found", timeout=3 * DEADLINE)
    finally:
        stop(process)
    found: dict[str, Any] = json.loads(reported.read_text())
    return found


def processes_with(text: str, *, started_by: Node | None = None) -> list[str]:
    """Return the command lines of running processes that contain `text`; if given, only those started by a node."""
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            command = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
            session = int((folder / "stat").read_text().rpartition(")")[2].split()[3])
        except OSError:
            continue  # ended in the meantime
        if text in command and (started_by is None or session == started_by.process.pid):
            found.append(command)
    return found
