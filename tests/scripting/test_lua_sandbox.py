# SPDX-License-Identifier: BSD-3-Clause
"""Actions forbidden for Lua scripts: running arbitrary programs, keeping the simulator from ending."""

import shutil
import signal
import time
from pathlib import Path

import pytest

from node_support import Node, run_script, write
from ros_support import RosCore, built


def launch(
    folder: Path, program: object, *options: object, name: str = "script.lua", arguments: str = "--help"
) -> tuple[int, str]:
    code = f"function sysCall_init()\n  print(pcall(sim.launchExecutable, '{program}', '{arguments}'))\nend\n"
    if name.endswith(".py"):
        code = f"def sysCall_init():\n    sim.launchExecutable('{program}', '-c true')\n"
    run = run_script(folder, code, *options, name=name)
    return run.returncode, run.stdout + run.stderr


def program_in(folder: Path) -> Path:
    folder.mkdir(parents=True)
    program = write(folder / "program", "#!/bin/sh\ntrue\n")
    program.chmod(0o755)
    return program


@pytest.mark.parametrize("program", ["sh", "/bin/sh", "../../../../../../../bin/sh", "rosrun"])
def test_a_script_in_lua_starts_no_program_of_the_machine(tmp_path: Path, program: str) -> None:
    _, output = launch(tmp_path, program)
    assert "must not start /" in output or "not found in" in output
    assert "true" not in output


def test_the_refusal_names_the_option(tmp_path: Path) -> None:
    shell = shutil.which("sh")
    assert f"node's option --allow-programs {shell}" in launch(tmp_path, "sh")[1]


def test_a_script_in_lua_starts_listed_programs_of_this_package(tmp_path: Path) -> None:
    output = launch(tmp_path, "rosBubbleRob")[1]
    assert any(line.startswith("true\t") for line in output.splitlines())  # perhaps after what the program prints


@pytest.mark.parametrize("program", ["sim", "bubblesim", "add_message", "map_server", "/usr/lib/rosbag/record"])
def test_a_script_in_lua_starts_no_program_that_widens_its_rights(tmp_path: Path, program: str) -> None:
    assert "must not start /" in launch(tmp_path, program)[1]


def test_a_package_lists_the_programs_for_scripts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    installed = program_in(tmp_path / "space" / "lib" / "robot")
    (tmp_path / "space" / "share" / "robot").mkdir(parents=True)
    source = program_in(tmp_path / "src" / "robot" / "scripts")
    monkeypatch.setenv("CMAKE_PREFIX_PATH", str(tmp_path / "space"), prepend=":")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "src"), prepend=":")
    for package, starts in (
        ("<package/>", False),
        ('<package><export><bubblesim programs="other"/></export></package>', False),
        ("not XML", False),
        ('<package><export><bubblesim programs="other program"/></export></package>', True),
    ):
        (tmp_path / "space" / "share" / "robot" / "package.xml").write_text(package)
        (tmp_path / "src" / "robot" / "package.xml").write_text(package)
        for program in (installed, source):
            assert launch(tmp_path, program)[1].startswith("true\t" if starts else "false\t"), package


def test_a_script_in_lua_names_no_log_file_of_a_ros_program(tmp_path: Path) -> None:
    log = tmp_path / "log"
    output = launch(tmp_path, "tricycle_avoid.py", arguments=f"__log:={log}")[1]
    assert f"must not pass __log:={log}" in output
    assert "must not pass" not in launch(tmp_path, "tricycle_avoid.py", arguments="__name:=avoider --help")[1]


def test_a_script_in_lua_has_a_limited_number_of_programs(tmp_path: Path) -> None:
    code = (
        "function sysCall_init()\n  for i = 1, 64 do sim.launchExecutable('sleep', '30') end\n"
        "  print(pcall(sim.launchExecutable, 'sleep', '30'))\nend\n"
    )
    run = run_script(tmp_path, code, "--allow-programs", "sleep", name="script.lua")
    assert "already runs 64 programs" in run.stdout


def test_the_user_allows_programs_and_folders(tmp_path: Path) -> None:
    program = program_in(tmp_path / "tools")
    for allowed in (program, program.parent):
        assert launch(tmp_path, program, "--allow-programs", allowed)[1].startswith("true\t")
    assert "true\t" in launch(tmp_path, "true", "--allow-programs", "true")[1]  # after what the program prints
    assert "must not start" in launch(tmp_path, program, "--allow-programs", tmp_path / "other")[1]


@pytest.mark.parametrize("options", [[], ["--lua-unsafe"]])
def test_scripts_without_a_sandbox_start_any_program(tmp_path: Path, options: list[str]) -> None:
    assert "must not start" not in launch(tmp_path, "sh", *options, name="script.lua" if options else "script.py")[1]


SLACK = 1.5  # s, for a busy machine
ENDLESS = {
    "a loop": "while true do end",
    "a coroutine": "coroutine.wrap(function() while true do end end)()",
    "a pcall in a loop": "while true do pcall(function() while true do end end) end",
    "an xpcall whose handler loops": (
        "xpcall(function() while true do end end, function() while true do end end) while true do end"
    ),
    "a coroutine in a loop": ("while true do coroutine.resume(coroutine.create(function() while true do end end)) end"),
    "a variable that is closed": (
        "while true do local x <close> = setmetatable({}, {__close = function() while true do end end}) end"
    ),
    "a string that is loaded": "while true do load(function() while true do end end) end",
    "the globals' metatable": (
        "debug = nil setmetatable(_G, {__index = function() while true do end end}) return missing"
    ),
    "debug.traceback": "debug.traceback = function() while true do end end while true do end",
    "an error that loops as a string": (
        "pcall(error, 1) local e = setmetatable({}, {__tostring = function() while true do end end}) "
        "while true do pcall(error, e) end"
    ),
}


@pytest.mark.parametrize("body", ENDLESS.values(), ids=ENDLESS)
def test_sigterm_ends_a_script_that_does_not_return_with_its_cleanup(
    roscore: RosCore, tmp_path: Path, body: str
) -> None:
    code = f"function sysCall_init()\n  print('begun')\n  {body}\nend\nfunction sysCall_cleanup() print('cleanup') end"
    script = write(tmp_path / "script.lua", code)
    with Node(roscore.env, tmp_path / "log", "ball", "--child-script", f"/Ball={script}") as node:
        node.wait_for_output("begun")
        node.wait_until_listed(roscore)
        begin = time.monotonic()
        assert node.end(signal.SIGTERM) == 0
        assert time.monotonic() - begin < 2.0 + SLACK
        assert f"child script of /Ball was interrupted in sysCall_init ({script}:3)" in node.output
        assert node.output.endswith("cleanup\n")


def failure(folder: Path, code: str) -> str:
    run = run_script(folder, code, "--strict", name="script.lua")
    assert run.returncode == 3
    return run.stderr


def test_there_are_no_finalizers(tmp_path: Path) -> None:
    reported = failure(
        tmp_path, "function sysCall_init()\n  setmetatable({}, {__gc = function() while true do end end})\nend"
    )
    assert f"{tmp_path}/script.lua:2: setmetatable: finalizers (__gc) are not allowed in child scripts" in reported


def test_a_finalizer_that_comes_later_is_never_called(tmp_path: Path) -> None:
    code = """
        function sysCall_init()
          local late = {}
          setmetatable({}, late)
          late.__gc = function() print('finalized') end
          collectgarbage()
          print('end')
        end
    """
    run = run_script(tmp_path, code, "--strict", name="script.lua")
    assert (run.stdout, run.stderr) == ("end\n", "")


def test_the_text_of_an_error_object_is_made_without_its_metatable(tmp_path: Path) -> None:
    reported = failure(tmp_path, "error(setmetatable({}, {__tostring = function() while true do end end}))")
    assert "an error that is not a string: a table" in reported


def test_texts_keep_their_metatable(tmp_path: Path) -> None:
    code = "function sysCall_init() print(getmetatable(''), ('x'):rep(3), load('return self ~= nil')()) end"
    run = run_script(tmp_path, code, name="script.lua")
    assert (run.stdout, run.stderr) == ("false\txxx\ttrue\n", "")


def test_an_error_within_a_wait_keeps_its_text(tmp_path: Path) -> None:
    reported = failure(tmp_path, "function sysCall_init()\n  sim.wait(1)\nend")
    assert f"{tmp_path}/script.lua:2: sim.wait is only allowed in sysCall_thread" in reported
    reported = failure(tmp_path, "function sysCall_thread()\n  sim.wait('long')\nend")
    assert f"{tmp_path}/script.lua:2: sim.wait: argument 1, seconds: expected a number" in reported


@pytest.mark.parametrize("kind", ["init", "thread"])
def test_an_error_in_a_coroutine_keeps_its_text(tmp_path: Path, kind: str) -> None:
    code = f"""
        function sysCall_{kind}()
          local waiting = coroutine.create(function()
            sim.wait(1)
          end)
          local succeeded, problem = coroutine.resume(waiting)
          if not succeeded then error(debug.traceback(waiting, problem), 2) end
        end
    """
    reported = failure(tmp_path, code)
    assert f"{tmp_path}/script.lua:4: sim.wait is only allowed in sysCall_thread" in reported
    assert "sandbox" not in reported


def test_print_shows_the_contents_of_tables(tmp_path: Path) -> None:
    code = """
        function sysCall_init()
          local itself = {}
          itself[1] = itself
          print({}, {1, 2.5, 'text', true}, {b = 1, a = {c = {}}, ['not plain'] = false, [7] = 0})
          print(itself, setmetatable({}, {__tostring = function() return 'its own' end}))
          print(sim.getObjectPosition(sim.getObject('.'))[1], 'plain', nil)
          local long = {}
          for i = 1, 1000 do long[i] = i end
          print(#tostring(print) > 0, long)
        end
    """
    run = run_script(tmp_path, code, "--strict", name="script.lua")
    assert run.stderr == ""
    tables, special, plain, long = run.stdout.splitlines()
    assert tables == "{}\t{1, 2.5, 'text', true}\t{[7] = 0, a = {c = {}}, b = 1, ['not plain'] = false}"
    assert special == "{{the table itself}}\tits own"
    assert plain == "-1.5\tplain\tnil"
    assert long.endswith("99, 100, ...}")


@pytest.mark.parametrize("file", ["a_name_" * 10 + "that_is_too_long_for_lua.lua", "with space.lua", "grün.lua"])
def test_files_are_named_whole(tmp_path: Path, file: str) -> None:
    code = (
        "function inner() error('deep') end\nfunction sysCall_init()\n  print(debug.traceback('x'))\n  inner()\nend\n"
    )
    run = run_script(tmp_path, code, "--strict", name=file)
    whole = str(tmp_path / file)
    assert f"{whole}:1: deep" in run.stderr
    assert f"{whole}:4: in function <{whole}:2>" in run.stderr
    assert f"{whole}:3: in function <{whole}:2>" in run.stdout
    assert run.stderr.count(file) == run.stderr.count(whole)


def test_files_of_one_name_are_distinguished(tmp_path: Path) -> None:
    other = tmp_path / "other"
    other.mkdir()
    write(other / "script.lua", "return function()\n  error('in the other')\nend\n")
    code = "local fail = require('other.script')\nfunction sysCall_init()\n  fail()\nend\n"
    reported = failure(tmp_path, code)
    assert f"{other}/script.lua:2: in the other" in reported
    assert f"{tmp_path}/script.lua:3: in function" in reported


def test_the_programs_of_this_test_exist() -> None:
    assert built("rosBubbleRob").is_file()


def test_a_script_in_lua_may_end_the_simulator_as_sim_allows(tmp_path: Path) -> None:
    code = "function sysCall_init() end\nfunction sysCall_actuation() sim.quitSimulator() end\n"
    run = run_script(tmp_path, code, name="script.lua", until=1000.0)
    assert run.returncode == 0
