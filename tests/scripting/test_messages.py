# SPDX-License-Identifier: BSD-3-Clause
"""Messages between scripts, code from strings, and calls at a later time."""

from pathlib import Path

from node_support import run_script


def test_a_broadcast_reaches_the_scripts_with_its_sender(tmp_path: Path) -> None:
    code = """
        function sysCall_init()
            own = sim.getObject('.')
            sim.broadcastMsg({id = 'ready', data = {x = 3}})
        end
        function sysCall_actuation()
            if not sent then sim.broadcastMsg({id = 'go', data = {x = 4}}) end
            sent = true
        end
        function sysCall_msg(message, origin)
            print(message.id, message.data.x, origin == own)
        end
    """
    run = run_script(tmp_path, code, "--strict", name="script.lua")
    assert run.stderr == ""
    assert run.stdout == "ready\t3\ttrue\ngo\t4\ttrue\n"


SENDER = """
function sysCall_init()
    receiver = sim.getObject('/FrontMotor')
    sim.addScript(sim.scripttype_simulation, [[
        function sysCall_init() seen = {} end
        function sysCall_sensing()
            local data, sender, header, name = sim.receiveData(7)
            while data do
                print(data, header, name, sim.getObjectAlias(sender))
                data, sender, header, name = sim.receiveData(7)
            end
        end
    ]], 'lua')
end
function sysCall_actuation()
    if sim.getSimulationTime() > 0.09 and not sent then
        sent = true
        sim.sendData(sim.handle_all, 7, 'speed', 'fast')
        sim.sendData(sim.handle_all, 8, 'speed', 'other header')
        sim.sendData(sim.handle_all, 7, 'speed', 'far away', sim.handle_self, 0.001)
    end
    assert(sim.receiveData(7) == nil)  -- not from itself
end
"""


def test_data_reach_other_scripts_once_by_header_and_distance(tmp_path: Path) -> None:
    run = run_script(
        tmp_path, SENDER, "--strict", name="script.lua", scene="tricycle", target="/Tricycle", until=0.4, prefixed=False
    )
    assert run.stderr == ""
    assert run.stdout == "fast\t7\tspeed\tTricycle\n"


def test_code_of_a_string_runs_with_the_globals_of_a_script(tmp_path: Path) -> None:
    in_lua = """
        x = 4
        function sysCall_init()
            print(sim.executeScriptString('x + 1', sim.handle_self))
            print(sim.executeScriptString('x = 7', sim.handle_self), x)
            print(pcall(sim.executeScriptString, 'x +', sim.handle_self))
        end
    """
    run = run_script(tmp_path, in_lua, "--strict", name="script.lua")
    assert run.stdout.splitlines()[:2] == ["5", "nil\t7"]
    assert run.stdout.splitlines()[2].startswith("false\t")
    in_python = """
        x = 4
        def sysCall_init():
            print(sim.executeScriptString('x + 1', sim.handle_self), sim.executeScriptString('x = 7', '/Ball'), x)
    """
    run = run_script(tmp_path, in_python, "--strict")
    assert run.stdout == "5 None 7\n"


def test_a_lua_script_runs_no_code_in_a_python_script(tmp_path: Path) -> None:
    (tmp_path / "other.py").write_text("def sysCall_init():\n    pass\n")
    code = """
        function sysCall_actuation()
            local done, why = pcall(sim.executeScriptString, 'print(1)', '/Robot')
            if not reported then print(done, string.find(why, 'Lua scripts only') ~= nil) end
            reported = true
        end
        function sysCall_init() end
    """
    extra = ("--child-script", f"/Tricycle/base_link={tmp_path / 'other.py'}")
    code = code.replace("/Robot", "/Tricycle/base_link")
    run = run_script(tmp_path, code, "--strict", *extra, name="script.lua", scene="tricycle", target="/Tricycle")
    assert run.stdout == "false\ttrue\n"


def test_calls_are_made_when_their_time_has_come_unless_they_are_cancelled(tmp_path: Path) -> None:
    code = """
        def sysCall_init():
            sim.scheduleExecution(lambda n: print(n, sim.getSimulationTime()), [3], 0.1, True)
            late = sim.scheduleExecution('later', [], 0.05, True)
            assert sim.cancelScheduledExecution(late) and not sim.cancelScheduledExecution(late)
        def later():
            print('never')
    """
    run = run_script(tmp_path, code, "--strict")
    assert run.stderr == ""
    assert run.stdout == "3 0.1\n"
