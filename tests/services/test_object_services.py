# SPDX-License-Identifier: BSD-3-Clause
"""The services that read and set objects, called by other nodes."""

import math
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml

from node_support import NAME, Node, write
from ros_support import RosCore, wait_until

# Two links in one plane: the platform turns about z, and a box lies on it without contacts.
SCENE = """\
<?xml version="1.0"?>
<sdf version="1.9">
  <world name="two">
    <gravity>0 0 0</gravity>
    <physics name="default" type="ode"><max_step_size>0.005</max_step_size></physics>
    <model name="Platform"><pose>1 2 0 0 0 1.5707963267948966</pose><link name="link"/></model>
    <model name="Box"><pose>1 3 0 0 0 0</pose><link name="link"/></model>
  </world>
</sdf>
"""


class Caller:
    def __init__(self, core: RosCore) -> None:
        self._core = core

    def error(self, service: str, **request: Any) -> str:
        """Return rosservice's error output of a failed call."""
        command = ["rosservice", "call", f"{NAME}/{service}", yaml.safe_dump(request)]
        failed = subprocess.run(command, env=self._core.env, capture_output=True, text=True, check=False)
        assert (failed.returncode, failed.stdout) == (2, "")
        return failed.stderr

    def __call__(self, service: str, **request: Any) -> Any:
        answer = self._core.run("rosservice", "call", f"{NAME}/{service}", yaml.safe_dump(request))
        return yaml.safe_load(answer)


@pytest.fixture
def call(roscore: RosCore, tmp_path: Path) -> Iterator[Caller]:
    """Run a paused scene without scripts."""
    with Node(roscore.env, tmp_path / "log", write(tmp_path / "two.sdf", SCENE), "--paused") as node:
        wait_until(lambda: f"{NAME}/get_object_state" in roscore.state()["services"], "the services")
        yield Caller(roscore)
        assert node.end() == 0


def position(answer: Any) -> list[float]:
    return [answer["pose"]["position"][axis] for axis in "xyz"]


def test_a_pose_that_was_set_is_read_back(call: Caller) -> None:
    turned = {"z": math.sin(0.5), "w": math.cos(0.5)}
    done = call("set_object_pose", object="/Box", pose={"position": {"x": 4.0}, "orientation": turned})
    assert done == {"success": True, "status_message": ""}
    state = call("get_object_state", object="/Box")
    assert state["success"]
    assert position(state) == pytest.approx([4, 0, 0])
    assert state["pose"]["orientation"] == pytest.approx({"x": 0, "y": 0, **turned})
    assert state["twist"]["linear"] == {"x": 0, "y": 0, "z": 0}


def test_poses_may_be_relative_to_an_object(call: Caller) -> None:
    # The platform faces y: a point at y + 1 is 1 m ahead of it.
    assert position(call("get_object_state", object="/Box", reference="/Platform")) == pytest.approx([1, 0, 0])
    ahead = {"position": {"x": 3.0}, "orientation": {"w": 1.0}}
    assert call("set_object_pose", object="/Box", pose=ahead, reference="/Platform")["success"]
    assert position(call("get_object_state", object="/Box")) == pytest.approx([1, 5, 0])


def test_what_is_wrong_is_reported_and_changes_nothing(call: Caller) -> None:
    before = call("get_object_state", object="/Box")
    good = {"position": {"x": 1.0}, "orientation": {"w": 1.0}}
    for request, hint in (
        ({"object": "/Bos", "pose": good}, "/Box"),
        ({"object": "/Box", "pose": good, "reference": "/Platfrom"}, "/Platform"),
        ({"object": "/Box", "pose": {"position": {"x": math.nan}, "orientation": {"w": 1.0}}}, "finite"),
        ({"object": "/Box", "pose": {"position": {"x": 1.0}}}, "quaternion of length 1"),
    ):
        answer = call("set_object_pose", **request)
        assert answer["success"] is False
        assert hint in answer["status_message"]
    assert call("get_object_state", object="/Box") == before


def test_a_state_that_cannot_be_read_fails_the_call_with_the_reason_alone(call: Caller) -> None:
    for request, reason in (
        ({"object": "/Bos"}, "no object matches '/Bos'; did you mean /Box?"),
        ({"object": "/Box", "reference": "/Platfrom"}, "no object matches '/Platfrom'; did you mean /Platform?"),
    ):
        service = f"ERROR: service [{NAME}/get_object_state] responded with an error: "
        assert reason in call.error("get_object_state", **request)
        assert call.error("get_object_state", **request).startswith(service)
        assert call.error("get_object_state", **request).count("\n") == 1
