# SPDX-License-Identifier: BSD-3-Clause
"""Error messages for scripts that use a missing module or function."""

from pathlib import Path

import pytest

from bubblesim.scripting.api.functions import MODULES, functions
from bubblesim.scripting.api.missing_names import explain
from bubblesim.scripting.api.ros import ros_modules  # noqa: F401  # registers modules
from bubblesim.scripting.api.sim import sim_module  # noqa: F401  # registers modules
from node_support import run_script, write

NO_ROS = "the node was started with --no-ros; to run with and without ROS, test `if simROS`"


def failure(folder: Path, code: str, name: str = "script.py") -> str:
    run = run_script(folder, code, "--strict", name=name)
    assert run.returncode == 3
    return run.stderr


def test_without_ros_the_first_use_of_simros_states_why(tmp_path: Path) -> None:
    reported = failure(tmp_path, "def sysCall_init():\n    simROS.advertise('/t', 'std_msgs/Float32')\n")
    assert f"simROS.advertise: {NO_ROS}" in reported
    assert "script.py:2" in reported
    assert "NoneType" not in reported


def test_without_ros_simros_is_false(tmp_path: Path) -> None:
    code = """
        def sysCall_init():
            print(bool(simROS), bool(simROS2), hasattr(simROS, 'advertise'))
    """
    run = run_script(tmp_path, code)
    assert (run.stdout, run.stderr) == ("False False False\n", "")


@pytest.mark.parametrize("begin", ["", "simROS = require 'simROS'\n", "local simROS = require 'simROS'\n"])
def test_without_ros_the_first_use_of_simros_in_lua_states_why(tmp_path: Path, begin: str) -> None:
    code = begin + "function sysCall_init()\n  simROS.advertise('/t', 'std_msgs/Float32')\nend\n"
    reported = failure(tmp_path, code, "script.lua")
    assert f"script.lua:{2 + begin.count(chr(10))}: {NO_ROS}" in reported


def test_without_ros_old_names_of_simros_state_why(tmp_path: Path) -> None:
    reported = failure(tmp_path, "function sysCall_init() simExtROS_sendTransforms({}) end", "script.lua")
    assert f"script.lua:1: {NO_ROS}" in reported


def test_without_ros_simros_is_false_in_lua(tmp_path: Path) -> None:
    run = run_script(tmp_path, "function sysCall_init() if not simROS then print('no ROS') end end", name="script.lua")
    assert (run.stdout, run.stderr) == ("no ROS\n", "")


@pytest.mark.parametrize(
    ("call", "reported"),
    [
        ("sim.setObjectPos", "sim has no setObjectPos; did you mean sim.setObjectPose or sim.setObjectPosition?"),
        ("sim.wantsMessages", "sim has no wantsMessages; did you mean simROS.wantsMessages or simROS2.wantsMessages?"),
        ("sim.xyzzy", "sim has no xyzzy; `bubblesim api` lists all functions"),
    ],
)
def test_a_misspelt_function_is_reported_with_what_was_meant_in_both_languages(
    tmp_path: Path, call: str, reported: str
) -> None:
    assert reported in failure(tmp_path, f"def sysCall_init():\n    {call}(1)\n")
    in_lua = failure(tmp_path, f"function sysCall_init()\n  {call}(1)\nend\n", "script.lua")
    assert f"{tmp_path}/script.lua:2: {reported}" in in_lua


@pytest.mark.parametrize(
    ("module", "wanted", "counterpart"),
    [
        ("simROS", "createPublisher", "simROS.advertise"),
        ("simROS2", "advertise", "simROS2.createPublisher"),
        ("simROS", "createSubscription", "simROS.subscribe"),
        ("simROS2", "imageTransportSubscribe", "simROS2.imageTransportCreateSubscription"),
    ],
)
def test_a_name_of_the_other_ros_module_is_reported_with_its_counterpart(
    module: str, wanted: str, counterpart: str
) -> None:
    text = explain(module, wanted, MODULES)
    assert text.startswith(f"{module} has no {wanted}, which is a function of simROS")
    assert text.endswith(f"use {counterpart}")


def test_every_function_that_one_ros_module_has_under_another_name_has_a_counterpart() -> None:
    for module, other in (("simROS", "simROS2"), ("simROS2", "simROS")):
        for function in functions(MODULES[other]):
            if not hasattr(MODULES[module], function.name) and "counterpart" in explain(module, function.name, MODULES):
                name = explain(module, function.name, MODULES).rpartition(".")[2]
                assert hasattr(MODULES[module], name)


def test_a_function_that_lua_does_not_find_is_nil_and_its_call_can_be_caught(tmp_path: Path) -> None:
    code = """
        function sysCall_init()
          print(sim.setObjectPos)
          local succeeded, problem = pcall(function() sim.setObjectPos(1) end)
          print(problem)
        end
    """
    run = run_script(tmp_path, code, name="script.lua")
    assert run.stderr == ""
    first, second = run.stdout.splitlines()
    assert first == "nil"
    assert "sim has no setObjectPos; did you mean sim.setObjectPose" in second


@pytest.mark.parametrize(
    ("call", "reported"),
    [
        ("sim.getObjectPosition(-1)", "sim.getObjectPosition: argument 1, handle: -1 is not a handle of an object"),
        ("sim.setObjectPosition(-1, [0, 0, 0])", "sim.setObjectPosition: argument 1, handle: -1 is not a handle"),
        (
            "sim.getObjectPosition(sim.getObject('.'), -99)",
            "sim.getObjectPosition: argument 2, relative_to: -99 is not a handle of an object",
        ),
        ("sim.getVisionSensorCharImage(-1)", "sim.getVisionSensorCharImage: argument 1, sensor: -1 is not a handle"),
    ],
)
def test_what_is_no_handle_is_reported_with_function_argument_and_line(
    tmp_path: Path, call: str, reported: str
) -> None:
    report = failure(tmp_path, f"def sysCall_init():\n    {call}\n")
    assert reported in report
    assert "script.py:2" in report
    in_lua = call.replace("[", "{").replace("]", "}")
    assert reported in failure(tmp_path, f"function sysCall_init()\n  {in_lua}\nend\n", "script.lua")


@pytest.mark.parametrize(
    ("name", "reported"),
    [
        ("sysCall_actuaton", "sysCall_actuaton is never called; did you mean sysCall_actuation?"),
        ("sysCall_clenup", "sysCall_clenup is never called; did you mean sysCall_cleanup?"),
        ("sysCall_triger", "sysCall_triger is never called; did you mean sysCall_trigger?"),
        ("sysCall_mesage", "sysCall_mesage is never called; did you mean sysCall_msg?"),
        ("sysCall_zzz", "sysCall_zzz is never called; the callbacks are sysCall_init, sysCall_thread,"),
    ],
)
def test_a_callback_that_is_never_called_is_one_warning_with_what_is_near(
    tmp_path: Path, name: str, reported: str
) -> None:
    for file, code in {
        "script.py": f"def sysCall_init(): pass\ndef {name}(): pass\n",
        "script.lua": f"function sysCall_init() end\nfunction {name}() end\n",
    }.items():
        run = run_script(tmp_path, code, name=file)
        assert run.stderr.startswith(f"warning: child script of /Ball: {tmp_path}/{file}:2: {reported}")
        assert run.stderr.count("\n") == 1


def test_other_functions_are_nothing_to_warn_of(tmp_path: Path) -> None:
    code = "def sysCall_init(): pass\ndef sysCall_cleanup(): pass\ndef actuation(): pass\nsysCall_rate = 5\n"
    run = run_script(tmp_path, code)
    assert (run.stdout, run.stderr) == ("", "")


def test_a_misspelt_init_is_named(tmp_path: Path) -> None:
    reported = failure(tmp_path, "def sysCall_int(): pass\n")
    assert "did you mean sysCall_init?" in reported
    assert "it defines neither sysCall_init" in reported


def test_time_counts_from_the_start_of_the_node(tmp_path: Path) -> None:
    code = """
        first = sim.getSystemTimeInMs(-1)
        assert first > 0
        def sysCall_init():
            seconds = sim.getSystemTime()
            assert abs(sim.getSystemTimeInMs(-1) * 1e-3 - seconds) < 5 and sim.getSystemTimeInMs(-1) >= first
    """
    run = run_script(tmp_path, code, "--strict")
    assert (run.stderr, run.returncode) == ("", 0)


TWO_BALLS = """\
<?xml version="1.0"?>
<sdf version="1.9" xmlns:bubblesim="https://bubblesim">
  <world name="two">
    <physics name="default" type="ode"><max_step_size>0.005</max_step_size></physics>
    <model name="A"><link name="same"/><link name="other"/></model>
    <model name="B"><link name="same"/></model>
  </world>
</sdf>
"""


def test_an_alias_has_the_handle_where_the_name_alone_is_not_enough(tmp_path: Path) -> None:
    scene = write(tmp_path / "two.sdf", TWO_BALLS)
    code = """
        def sysCall_init():
            for path in ('/A/same', '/B/same', '/A/other'):
                handle = sim.getObject(path)
                print(*(sim.getObjectAlias(handle, option).replace(str(handle), 'H') for option in (3, 4)))
    """
    run = run_script(tmp_path, code, "--strict", scene=str(scene), target="/A")
    assert run.stdout.splitlines() == ["same__H__ same__H__", "same__H__ same__H__", "other other__H__"]
