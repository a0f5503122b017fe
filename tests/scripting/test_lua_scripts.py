# SPDX-License-Identifier: BSD-3-Clause
"""Child scripts in Lua: the same callbacks, functions and error reports as in Python, and no access to the outside."""

import os
import subprocess
from pathlib import Path

import pytest

from bubblesim.scripting.api.functions import functions
from bubblesim.scripting.api.sim.sim_module import SimApi
from node_support import Node, built, clean_environment, run_script, without_slowness, write
from ros_support import RosCore


def run_lua(folder: Path, code: str, *arguments: object, until: float = 0.2) -> "subprocess.CompletedProcess[str]":
    return run_script(folder, code, "--strict", *arguments, name="script.lua", until=until)


def lines(folder: Path, code: str, *arguments: object, until: float = 0.2) -> list[str]:
    run = run_lua(folder, code, *arguments, until=until)
    assert run.stderr == ""
    assert run.returncode == 0
    return run.stdout.splitlines()


def test_callbacks_come_in_order_under_one_time_a_pass(tmp_path: Path) -> None:
    code = """
        local function report(what) print(what, string.format('%.3f', sim.getSimulationTime())) end
        function sysCall_init() report('init') end
        function sysCall_actuation() report('actuation') end
        function sysCall_sensing() report('sensing') end
        function sysCall_cleanup() report('cleanup') end
    """
    assert lines(tmp_path, code, until=0.1) == [
        "init\t0.000",
        "actuation\t0.000",
        "sensing\t0.000",
        "actuation\t0.050",
        "sensing\t0.050",
        "cleanup\t0.100",
    ]


def test_the_header_makes_any_file_lua(tmp_path: Path) -> None:
    run = run_script(tmp_path, "#lua\nfunction sysCall_init() print(7 // 2) end\n", name="script.txt")
    assert (run.stdout, run.stderr) == ("3\n", "")


def test_the_same_script_in_both_languages_leads_to_the_same_state(tmp_path: Path) -> None:
    python = """
        def sysCall_init():
            self.ball = sim.getObject('.')
        def sysCall_actuation():
            x, y, z = sim.getObjectPosition(self.ball, sim.handle_world)
            sim.setObjectPosition(self.ball, sim.handle_world, [x + 0.01, y, z])
    """
    lua = """
        function sysCall_init()
            ball = sim.getObject('.')
        end
        function sysCall_actuation()
            local x, y, z = table.unpack(sim.getObjectPosition(ball, sim.handle_world))
            sim.setObjectPosition(ball, sim.handle_world, {x + 0.01, y, z})
        end
    """
    assert (
        lines(tmp_path, lua, "--state-hash", until=1)
        == run_script(tmp_path, python, "--state-hash", until=1).stdout.splitlines()
    )


def test_every_function_of_sim_is_there(tmp_path: Path) -> None:
    code = """
        function sysCall_init()
            for name, value in pairs(sim) do
                if type(value) == 'function' then print(name) end
            end
        end
    """
    assert sorted(lines(tmp_path, code)) == sorted(function.name for function in functions(SimApi))


def test_several_results_are_several_values_and_lists_count_from_one(tmp_path: Path) -> None:
    code = """
        function sysCall_init()
            local sonar = sim.getObject('/Tricycle/FrontSonar')
            local result, distance, point, object, normal = sim.readProximitySensor(sonar)
            print(math.type(result), math.type(distance), #point, object, #normal)
            sim.setStringSignal('bytes', 'a\\0\\255')
            print(#sim.getStringSignal('bytes'), sim.getStringSignal('unset'))
            print(table.concat(sim.unpackDoubleTable(sim.packDoubleTable({1, 2, 0.5})), ' '))
        end
    """
    run = run_script(tmp_path, code, "--strict", name="script.lua", scene="tricycle", target="/Tricycle", until=0.05)
    assert run.stderr == ""
    assert run.stdout.splitlines() == ["integer\tfloat\t3\t-1\t3", "3\tnil", "1.0 2.0 0.5"]


def test_whole_numbers_of_divisions_are_handles_and_counts(tmp_path: Path) -> None:
    code = "function sysCall_init() print(sim.getObjectAlias(2 * sim.getObject('.') / 2, 4 / 2)) end"
    assert lines(tmp_path, code) == ["/Ball"]


def test_require_gives_modules_and_files_of_lua(tmp_path: Path) -> None:
    other = tmp_path / "other"
    other.mkdir()
    write(other / "wheels.lua", "local wheels = {radius = 0.2}\nprint('read')\nreturn wheels\n")
    code = """
        local wheels = require('wheels')
        function sysCall_init()
            print(require('sim') == sim, require('sim-2') == sim, simROS, require('wheels') == wheels, wheels.radius)
        end
    """
    assert lines(tmp_path, code, "--script-path", other) == ["read", "true\ttrue\tnil\ttrue\t0.2"]


def test_scripts_keep_their_globals_to_themselves(tmp_path: Path) -> None:
    first = write(tmp_path / "first.lua", "shared = 1 sim.extra = 1 function sysCall_init() end")
    code = "function sysCall_init() print(shared, sim.extra) end"
    run = run_script(
        tmp_path, code, "--child-script", f"/Ball={first}", name="script.lua", scene="ball", target="/Floor"
    )
    assert (run.stdout, run.stderr) == ("nil\tnil\n", "")


@pytest.mark.parametrize(
    ("code", "report"),
    [
        ("x = = 3", "script.lua:1: unexpected symbol near '='"),
        ("function sysCall_init()\n  x.y = 1\nend", "script.lua:2) and is disabled:\n{file}:2: attempt to index a nil"),
        (
            "function sysCall_init()\n  sim.setObjectPosition(4, {1, 2})\nend",
            "{file}:2: sim.setObjectPosition: argument 2, position: expected 3 numbers, found 2",
        ),
        ("function sysCall_init()\n  sim.getObject('/Bal')\nend", "{file}:2: no object matches '/Bal'"),
        ("function sysCall_init()\n  sim.getObjct()\nend", "{file}:2: sim has no getObjct; did you mean sim.getObject"),
        ("function sysCall_init()\n  nothing()\nend", "{file}:2: attempt to call a nil value (global 'nothing')"),
        ("require('nothing')", "{file}:1: file not found: nothing.lua in {folder}"),
        ("function sysCall_actuation() end", "it defines neither sysCall_init"),
        ("function sysCall_thread()\n  sim.step()\n  x.y = 1\nend", "sysCall_thread ({file}:3) and is disabled"),
        ("local function f() return 1 + f() end\nfunction sysCall_init() f() end", "{file}:1: stack overflow"),
        ("function sysCall_init() t = 'x' while true do t = t .. t end end", "not enough memory"),
        ("error({code = 1})", "an error that is not a string: {{code = 1}}"),
        ("error(setmetatable({1}, {__tostring = function() error('no') end}))", "error that is not a string: a table"),
        ("function sysCall_thread()\n  error({1})\nend", "an error that is not a string: {{1}}"),
        (
            "function sysCall_init()\n  local t = {} t[1] = t\n  sim.packTable(t)\nend",
            "{file}:3: a table contains itself",
        ),
    ],
)
def test_a_failing_script_is_reported_with_its_line(tmp_path: Path, code: str, report: str) -> None:
    run = run_lua(tmp_path, code)
    assert run.returncode == 3
    assert "child script of /Ball" in run.stderr
    assert report.format(file=tmp_path / "script.lua", folder=tmp_path) in run.stderr
    assert "sandbox" not in run.stderr


def test_errors_of_functions_can_be_caught(tmp_path: Path) -> None:
    code = """
        function sysCall_init()
            print(pcall(function() sim.getObject('/nothing') end))
        end
    """
    assert lines(tmp_path, code) == [f"false\t{tmp_path}/script.lua:3: no object matches '/nothing'"]


def test_a_thread_steps_with_the_simulation(tmp_path: Path) -> None:
    code = """
        function sysCall_thread()
            sim.setStepping(true)
            for i = 1, 2 do
                print('thread', sim.getSimulationTime())
                sim.step()
            end
            print('late', sim.wait(0.06), sim.getSimulationTime())
        end
        function sysCall_sensing() print('sensing', sim.getSimulationTime()) end
    """
    assert lines(tmp_path, code, until=0.25) == [
        "thread\t0.0",
        "sensing\t0.0",
        "thread\t0.05",
        "sensing\t0.05",
        "sensing\t0.1",
        "sensing\t0.15",
        "late\t-0.04\t0.2",
        "sensing\t0.2",
    ]


def test_a_thread_that_does_not_step_is_switched_away_where_it_calls(tmp_path: Path) -> None:
    code = """
        function sysCall_thread()
            while sim.getSimulationTime() < 0.15 do end
            print('end')
        end
    """
    assert lines(tmp_path, code, until=0.25) == ["end"]


def test_a_thread_sets_how_long_its_turns_last(tmp_path: Path) -> None:
    code = """
        function sysCall_thread()
            sim.setThreadSwitchTiming(100)
            local begin, step = sim.getSystemTime(), sim.getSimulationTime()
            while sim.getSimulationTime() == step do end
            print(sim.getSystemTime() - begin > 0.09, sim.getThreadSwitchTiming())
        end
    """
    assert lines(tmp_path, code) == ["true\t100.0"]


def test_a_thread_finishes_its_work_when_it_is_to_end(tmp_path: Path) -> None:
    code = """
        function sysCall_thread()
            while not sim.getThreadExitRequest() do sim.step() end
            local begin = sim.getSystemTime()
            while sim.getSystemTime() - begin < 0.02 do end
            print('finished')
        end
    """
    assert lines(tmp_path, code) == ["finished"]


def test_a_thread_sees_that_it_is_to_end(tmp_path: Path) -> None:
    code = """
        function sysCall_thread()
            while not sim.getThreadExitRequest() do sim.step() end
            print('reported')
        end
        function sysCall_cleanup() print('cleanup') end
    """
    assert lines(tmp_path, code) == ["reported", "cleanup"]


def test_a_thread_that_steps_for_ever_is_left(tmp_path: Path) -> None:
    code = """
        function sysCall_thread() while true do sim.step() end end
        function sysCall_cleanup() print('cleanup') end
    """
    assert lines(tmp_path, code) == ["cleanup"]


def test_a_thread_that_will_not_end_is_broken_off(tmp_path: Path) -> None:
    code = """
        function sysCall_thread()
            sim.setStepping(true)
            while not sim.getThreadExitRequest() do sim.step() end
            while true do end
        end
        function sysCall_cleanup() print('cleanup') end
    """
    run = run_lua(tmp_path, code)
    assert run.stdout == "cleanup\n"
    assert "the thread of the child script of /Ball does not end" in run.stderr


def test_callbacks_cannot_step(tmp_path: Path) -> None:
    run = run_lua(tmp_path, "function sysCall_init()\n  sim.step()\nend")
    assert f"{tmp_path}/script.lua:2: sim.step is only allowed in sysCall_thread" in run.stderr


OUTSIDE = [
    "os.popen",
    "io.execute",
    "package.loadlib",
    "dofile",
    "loadfile",
    "python",
    "debug.getinfo",
    "debug.getregistry",
]


@pytest.mark.parametrize("name", OUTSIDE)
def test_nothing_leads_outside(tmp_path: Path, name: str) -> None:
    assert lines(tmp_path, f"function sysCall_init() print({name}) end") == ["nil"]


def test_binary_code_is_refused(tmp_path: Path) -> None:
    code = "function sysCall_init() print(load(string.dump(function() end), 'x', 'b')) end"
    assert "attempt to load a binary chunk" in lines(tmp_path, code)[0]


def test_who_asks_for_it_may_reach_outside(tmp_path: Path) -> None:
    code = "function sysCall_init() print(os.getenv('HOME')) end"
    assert lines(tmp_path, code, "--lua-unsafe") == [os.environ["HOME"]]


def test_messages_services_and_named_callbacks_work(roscore: RosCore, tmp_path: Path) -> None:
    code = """
        function sysCall_init()
            simROS.subscribe('/received', 'sensor_msgs/LaserScan', 'on_scan')
            publisher = simROS.advertise('/received', 'sensor_msgs/LaserScan')
            simROS.advertiseService('/add', 'std_srvs/SetBool', function(request)
                return {success = request.data, message = 'from Lua'}
            end)
            client = simROS.serviceClient('/add', 'std_srvs/SetBool')
        end
        function sysCall_actuation()
            simROS.publish(publisher, {
                header = {frame_id = 'laser', stamp = simROS.getTime()}, ranges = {1, 2.5, 1 / 0}, intensities = {},
            })
        end
        function on_scan(scan)
            if done then return end
            done = true
            print(scan.header.frame_id, #scan.ranges, scan.ranges[2], scan.ranges[3], #scan.intensities)
            local answer = simROS.call(client, {data = true})
            print(answer.success, answer.message)
            print(pcall(simROS.publish, publisher, {rnges = {}}))
        end
    """
    script = write(tmp_path / "script.lua", code)
    with Node(roscore.env, tmp_path / "log", "ball", "--child-script", f"/Ball={script}") as node:
        node.wait_for_output("rnges")
        # Lines about ROS come from another thread, at any time.
        printed = [line for line in node.output.splitlines() if not line.startswith(("plugin ", "warning: "))]
        assert printed[:2] == ["laser\t3\t2.5\tinf\t0", "true\tfrom Lua"]
        assert "ranges" in printed[2]


def test_lua_runs_without_an_active_environment(tmp_path: Path) -> None:
    script = write(tmp_path / "script.lua", "function sysCall_init() print('here') end")
    environment = clean_environment()
    environment.pop("VIRTUAL_ENV", None)
    run = subprocess.run(
        [built("sim"), "ball", "--no-ros", "--until", "0.05", "--child-script", f"/Ball={script}"],
        env=environment,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert (run.stdout, without_slowness(run.stderr)) == ("[/Ball 0.000 s] here\n", "")


def test_surplus_arguments_are_ignored_with_one_warning(tmp_path: Path) -> None:
    code = """
        function sysCall_init()
            for i = 1, 2 do print(sim.getInt32Signal('s', false), sim.getSimulationTime(1, 2)) end
        end
    """
    run = run_lua(tmp_path, code)
    assert run.stdout == "nil\t0.0\n" * 2
    assert run.stderr.splitlines() == [
        f"warning: child script of /Ball: sim.{call}: too many positional arguments: the last ones are ignored"
        for call in ("getInt32Signal(name)", "getSimulationTime()")
    ]
