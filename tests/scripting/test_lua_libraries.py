# SPDX-License-Identifier: BSD-3-Clause
"""Lua as CoppeliaSim sets it up: functions of Lua 5.1 to 5.3, coroutines that wait, the harmless parts of os and io."""

from pathlib import Path

import pytest

from node_support import run_script


def lines(folder: Path, body: str, *options: object, until: float = 0.2) -> list[str]:
    run = run_script(folder, body, "--strict", *options, name="script.lua", until=until)
    assert run.stderr == ""
    return run.stdout.splitlines()


def in_init(folder: Path, body: str) -> list[str]:
    return lines(folder, f"function sysCall_init()\n{body}\nend")


def test_functions_of_older_versions_of_lua(tmp_path: Path) -> None:
    body = """
        print(math.atan2(1, 0) == math.pi / 2, math.pow(2, 10), math.log10(1000), table.getn({1, 2, 3}))
        print(unpack({1, 2}), loadstring('return 7')(), math.ldexp(1, 4), math.frexp(8))
        math.randomseed(1234.5)
        print(math.random() < 1, string.gfind('a b', '%a')())
    """
    assert in_init(tmp_path, body) == ["true\t1024.0\t3.0\t3", "1\t7\t16.0\t0.5\t4", "true\ta"]


def test_numbers_with_a_fraction_are_formatted_as_in_lua_5_1(tmp_path: Path) -> None:
    body = """
        print(string.format('%d %5.1f %x %s%%', 3.7, 2.5, -1.2 + 16, 'a'), ('%d'):format(-2.9))
        print(pcall(string.format, '%d', 'x'))
        sim.setStringSignal('n', 5) sim.setStringSignal('f', 0.5)
        print(sim.getStringSignal('n') .. sim.getStringSignal('f'))
        sim.setObjectPosition(sim.getObject('.'), {1, 2, 3, 4})
        print(sim.getObjectPosition(sim.getObject('.'))[3])
    """
    found = in_init(tmp_path, body)
    assert found[0] == "3   2.5 e a%\t-2"
    assert found[1].startswith("false\t")
    assert found[2:] == ["50.5", "3.0"]


def test_time_and_some_variables_are_there(tmp_path: Path) -> None:
    body = "print(os.time() > 1e9, type(os.clock()), os.date('%Y') > '2000', os.getenv('SHELL'), type(package.path))"
    assert in_init(tmp_path, body) == ["true\tnumber\ttrue\tnil\tstring"]


def test_files_beside_the_script_can_be_read(tmp_path: Path) -> None:
    (tmp_path / "data.csv").write_text("1,2\n3,4\nend")
    body = """
        local file = io.open('data.csv', 'r')
        print(file:read(), file:read('*l'), file:read('*a'), file:read())
        for line in io.lines('data.csv') do io.write(line, ';') end
        print(io.open('missing.csv') == nil)
    """
    assert in_init(tmp_path, body) == ["1,2\t3,4\tend\tnil", "true"]


@pytest.mark.parametrize(
    ("call", "results", "why"),
    [
        ("io.open('new.txt', 'w'):write('a', 1):close()", "true", "nothing is written to 'new.txt'"),
        ("io.open('/etc/passwd')", "nil", "is not beside the scene or the script"),
        ("io.open('../../../../../../etc/passwd')", "nil", "is not beside the scene or the script"),
        ("io.open('.hidden/key')", "nil", "is not beside the scene or the script"),
        ("os.execute('ls')", "nil", "start programs with sim.launchExecutable"),
        ("os.remove('data.csv')", "nil", "it changes files"),
        ("io.popen('ls'):read('*a')", "", "sim.launchExecutable"),
    ],
)
def test_the_rest_fails_as_without_permissions_and_a_warning_states_why(
    tmp_path: Path, call: str, results: str, why: str
) -> None:
    (tmp_path / ".hidden").mkdir()
    (tmp_path / ".hidden" / "key").write_text("secret")
    (tmp_path / "data.csv").write_text("1")
    code = f"function sysCall_init() for i = 1, 2 do print(({call})) end end"
    run = run_script(tmp_path, code, name="script.lua")
    assert run.stdout == f"{results}\n" * 2
    assert run.stderr.count(why) == 1
    assert sorted(file.name for file in tmp_path.iterdir()) == [".hidden", "data.csv", "script.lua"]


def test_a_script_cannot_end_the_simulator(tmp_path: Path) -> None:
    run = run_script(tmp_path, "function sysCall_init() os.exit() end", "--strict", name="script.lua")
    assert run.returncode == 3
    assert "sim.quitSimulator" in run.stderr


def test_a_link_that_leads_elsewhere_is_not_read(tmp_path: Path) -> None:
    (tmp_path / "link").symlink_to("/etc/passwd")
    run = run_script(tmp_path, "function sysCall_init() print((io.open('link'))) end", name="script.lua")
    assert run.stdout == "nil\n"
    assert "is not beside the scene or the script" in run.stderr


def test_helpers_of_coppeliasims_lua_are_there(tmp_path: Path) -> None:
    body = """
        local copy = table.deepcopy({1, {2}})
        print(copy[2][1], table.find({5, 6}, 6), string.split('a,b', ',')[2], string.startswith('abc', 'a'))
        printf('%d %s %s', 3, 'x', {1, 2})
        import 'simVision'
        print(type(simVision.sensorImgToWorkImg), type(loadPlugin('simIK').createEnvironment), require 'simMTB')
    """
    assert in_init(tmp_path, body) == ["2\t2\tb\ttrue", "3 x {1, 2}", "function\tfunction\tnil"]


def test_a_module_that_is_not_here_is_named_with_what_to_use(tmp_path: Path) -> None:
    code = "simSubprocess = require 'simSubprocess'\nfunction sysCall_init() simSubprocess.exec('ls') end"
    run = run_script(tmp_path, code, "--strict", name="script.lua")
    assert "CoppeliaSim's module simSubprocess is not here: sim.launchExecutable" in run.stderr
    run = run_script(tmp_path, "require('simMTB')\ndef sysCall_init(): pass", "--strict")
    assert "CoppeliaSim's module simMTB is not here" in run.stderr


COROUTINE = """
function sysCall_init() corout = coroutine.create(coroutineMain) end
function sysCall_actuation()
    if coroutine.status(corout) ~= 'dead' then
        local ok, errorMsg = coroutine.resume(corout)
        if errorMsg then error(debug.traceback(corout, errorMsg), 2) end
    end
end
"""


def test_a_coroutine_of_the_script_may_wait_and_switch(tmp_path: Path) -> None:
    body = """
        function coroutineMain()
            print(sim.getSimulationTime())
            sim.switchThread()
            print(sim.getSimulationTime())
            print(sim.wait(0.08), sim.getSimulationTime())
        end
    """
    assert lines(tmp_path, COROUTINE + body, until=0.4) == ["0.0", "0.05", "-0.02\t0.15"]


def test_a_coroutine_that_waits_for_a_signal_gets_its_value(tmp_path: Path) -> None:
    body = """
        function coroutineMain() print(sim.waitForSignal('go'), sim.getSimulationTime()) end
        function sysCall_sensing()
            if sim.getSimulationTime() > 0.09 then sim.setInt32Signal('go', 5) end
        end
    """
    assert lines(tmp_path, COROUTINE + body, until=0.4) == ["5\t0.15"]


def test_a_coroutine_without_end_gives_up_its_turn_unless_it_steps(tmp_path: Path) -> None:
    body = """
        function coroutineMain()
            while true do n = (n or 0) + 1 sim.getSimulationTime() end
        end
        function sysCall_cleanup() print(n > 10, sim.getSimulationTime() > 0.1) end
    """
    assert lines(tmp_path, COROUTINE + body) == ["true\ttrue"]


def test_stepping_that_is_set_in_init_is_for_the_thread(tmp_path: Path) -> None:
    body = """
        function sysCall_init() print(sim.setStepping(true)) end
        function sysCall_thread() print(sim.getStepping(), sim.setThreadAutomaticSwitch(true)) end
    """
    assert lines(tmp_path, body) == ["0", "1\t1"]


def test_the_modules_matrix_and_utils(tmp_path: Path) -> None:
    body = """
        require 'matrix'
        require 'utils'
        local m = Matrix(2, 2, {1, 2, 3, 4})
        print((m * m):data(), m:det(), (m:inv() * m - Matrix.eye(2)):norm() < 1e-12, m:t():rowdata(1))
        print(Vector({1, 2, 3}):dot(Vector({4, 5, 6})), Vector({1, 0, 0}):cross(Vector({0, 1, 0})):data())
        print(Matrix3x3:rotz(math.pi / 2):coldata(1)[2], table.join({1, 2}, '-'), string.split('a,b', ','))
    """
    assert in_init(tmp_path, body) == [
        "{7, 10, 15, 22}\t-2.0\ttrue\t{1, 3}",
        "32\t{0, 0, 1}",
        "1.0\t1-2\t{'a', 'b'}",
    ]


def test_nothing_as_custom_data_removes_it(tmp_path: Path) -> None:
    body = """
        local h = sim.getObject('.')
        sim.writeCustomDataBlock(h, 'tag', 'data')
        sim.writeCustomDataBlock(h, 'tag', nil)
        print(sim.readCustomDataBlock(h, 'tag'))
    """
    assert in_init(tmp_path, body) == ["nil"]


def test_old_programs_include_files_beside_the_script(tmp_path: Path) -> None:
    (tmp_path / "helpers.lua").write_text("function double(x) return 2 * x end\nreturn 5")
    body = "print(sim.includeRel('helpers.lua'), double(4), sim.includeAbs('/somewhere/helpers'))"
    assert in_init(tmp_path, body) == ["5\t8\t5"]


def test_a_script_does_not_include_itself(tmp_path: Path) -> None:
    """Scripts from a file of CoppeliaSim are named after their objects, as are the files that they include."""
    run = run_script(tmp_path, "sim.includeRel('/script.lua')", "--strict", name="script.lua")
    assert run.returncode == 3
    assert f"script.lua:1: file not found: script.lua in {tmp_path}" in run.stderr


def test_the_table_of_coppeliasims_own_files_is_there(tmp_path: Path) -> None:
    assert in_init(tmp_path, "_S.last = _S.last or 3 print(_S.last)") == ["3"]


def test_matrices_are_there_without_require(tmp_path: Path) -> None:
    body = "local m = Matrix(2, 2, {1, 2, 3, 4}) print((m * Vector({1, 1})):data()[2])"
    assert in_init(tmp_path, body)[0] in ("7", "7.0")
