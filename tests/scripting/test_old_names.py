# SPDX-License-Identifier: BSD-3-Clause
"""Names of older versions of CoppeliaSim, and of V-REP 3."""

from pathlib import Path

import pytest

from bubblesim.scripting.api.functions import MODULES
from bubblesim.scripting.api.ik import ik_module  # noqa: F401  # registers a module
from bubblesim.scripting.api.old_names import RENAMED, of_v_rep
from bubblesim.scripting.api.old_names_page import page
from bubblesim.scripting.api.sim import sim_module  # noqa: F401  # registers a module
from node_support import run_script
from ros_support import REPOSITORY


@pytest.mark.parametrize("module", RENAMED)
def test_present_names_are_there_and_old_ones_are_not(module: str) -> None:
    for old, new in RENAMED[module].items():
        assert hasattr(MODULES[module], new), new
        assert old not in dir(MODULES[module]), old


def test_the_page_is_that_of_the_table() -> None:
    file = REPOSITORY / "docs" / "child_scripts" / "old_names.md"
    assert file.read_text() == page(), f"write it anew: python -m bubblesim.scripting.api.old_names_page > {file}"


@pytest.mark.parametrize(
    ("name", "found"),
    [
        ("simGetObjectHandle", ("sim", "getObjectHandle")),
        ("sim_handle_self", ("sim", "handle_self")),
        ("simGetIntegerSignal", ("sim", "getInt32Signal")),
        ("simGetObjectIntParameter", ("sim", "getObjectInt32Parameter")),
        ("simRMLMoveToPosition", ("sim", "rmlMoveToPosition")),
        ("simExtRosInterface_publish", ("simROS", "publish")),
        ("simExtCustomUI_create", ("simUI", "create")),
        ("simGetInvertedMatrix", ("sim", "getMatrixInverse")),
        ("simulate", None),
        ("simNoSuchFunction", None),
    ],
)
def test_names_of_v_rep(name: str, found: tuple[str, str] | None) -> None:
    assert of_v_rep(name, lambda module, present: hasattr(MODULES[module], present)) == found


def test_an_old_name_works_in_both_languages_and_is_named_once(tmp_path: Path) -> None:
    in_python = "def sysCall_init():\n    sim.setIntegerSignal('a', 3)\n    print(sim.getIntegerSignal('a'))\n"
    in_lua = "function sysCall_init() sim.setIntegerSignal('a', 3) print(sim.getIntegerSignal('a')) end"
    for code, name in ((in_python, "script.py"), (in_lua, "script.lua")):
        run = run_script(tmp_path, code, "--strict", name=name)
        assert run.stdout == "3\n"
        assert run.stderr.count("is now") == 1
        assert "sim.setIntegerSignal is now sim.setInt32Signal" in run.stderr
        assert "docs/child_scripts/old_names.md" in run.stderr


CALL_TYPES = """
if (sim_call_type == sim_childscriptcall_initialization) then
    handle = simGetObjectAssociatedWithScript(sim_handle_self)
    steps = 0
    local p = simGetObjectPosition(handle, -1)
    print(#p, simGetObjectName(handle))
end
if (sim_call_type == sim_childscriptcall_actuation) then steps = steps + 1 end
if (sim_call_type == sim_childscriptcall_sensing) then sensed = steps end
if (sim_call_type == sim_childscriptcall_cleanup) then print(steps, sensed) end
"""


def test_a_script_of_v_rep_is_called_with_the_type_of_the_call(tmp_path: Path) -> None:
    run = run_script(tmp_path, CALL_TYPES, "--strict", name="script.lua", until=0.2)
    assert run.stdout == "3\tBall\n4\t4\n"


def test_a_threaded_script_of_v_rep_runs_as_a_thread(tmp_path: Path) -> None:
    code = """
        threadFunction = function()
            simWait(0.1)
            print(simGetSimulationTime())
        end
        simSetThreadAutomaticSwitch(false)
        res, err = xpcall(threadFunction, function(err) return debug.traceback(err) end)
        print(res)
    """
    assert run_script(tmp_path, code, "--strict", name="script.lua", until=0.3).stdout == "0.1\ntrue\n"


def test_sys_call_threadmain_is_the_thread(tmp_path: Path) -> None:
    code = "function sysCall_threadmain() sim.setStepping(true) sim.wait(0.1) print(sim.getSimulationTime()) end"
    run = run_script(tmp_path, code, "--strict", name="script.lua", until=0.3)
    assert (run.stdout, run.stderr) == ("0.1\n", "")


def test_an_unknown_function_of_v_rep_is_an_error_that_names_it(tmp_path: Path) -> None:
    code = "function sysCall_init() simDoWhatNobodyKnows(1) end"
    run = run_script(tmp_path, code, "--strict", name="script.lua")
    assert run.returncode == 3
    assert "script.lua:1: there is no function simDoWhatNobodyKnows here" in run.stderr


def test_old_functions_keep_their_arguments_and_results(tmp_path: Path) -> None:
    code = """
        function sysCall_init()
            local h = sim.getObject('.')
            print(sim.getNameSuffix('Bill#3'))
            print(sim.getNameSuffix('Bill'))
            print(sim.getObjectSizeFactor(h), sim.boolAnd32(6, 3), sim.isHandleValid(h), sim.isHandleValid(9999))
            sim.addObjectToSelection(sim.handle_single, h)
            print(#sim.getObjectSelection(), sim.getObjectSelection()[1] == h)
            sim.removeObjectFromSelection(sim.handle_all, -1)
            print(sim.getObjectSelection())
            print(sim.getScriptHandle() == h, sim.getScriptAssociatedWithObject(h) == h)
            local m = sim.buildMatrix({1, 2, 3}, {0, 0, 0})
            sim.invertMatrix(m)
            print(m[4], m[8], m[12])
        end
    """
    run = run_script(tmp_path, code, "--strict", name="script.lua")
    assert run.stdout.splitlines() == [
        "3\tBill",
        "-1\tBill",
        "1.0\t2\ttrue\tfalse",
        "1\ttrue",
        "nil",
        "true\ttrue",
        "-1.0\t-2.0\t-3.0",
    ]


def test_old_getters_of_parameters_have_two_results(tmp_path: Path) -> None:
    code = """
        function sysCall_init()
          local ball = sim.getObject('.')
          local result, mass = sim.getObjectFloatParameter(ball, sim.shapefloatparam_mass)
          local found, static = sim.getObjectInt32Parameter(ball, sim.shapeintparam_static)
          print(result, mass, found, static)
        end
    """
    run = run_script(tmp_path, code, "--strict", name="script.lua")
    assert (run.stdout, run.stderr) == ("1\t0.5\t1\t0\n", "")


def test_particles_that_a_script_has_not_are_removed_without_an_error(tmp_path: Path) -> None:
    code = "function sysCall_init() print(sim.removeParticleObject(-1)) end"
    assert run_script(tmp_path, code, "--strict", name="script.lua").stdout == "1\n"


def old_script(folder: Path, code: str, until: float = 0.15) -> str:
    run = run_script(folder, code, "--strict", name="script.lua", until=until)
    assert "error" not in run.stderr
    return run.stdout


def test_a_script_of_v_rep_3_5_compares_its_call_type_with_names_of_callbacks(tmp_path: Path) -> None:
    code = """
        if (sim_call_type==sim.syscb_init) then count = 0 print('init') end
        if (sim_call_type==sim.syscb_actuation) then count = count + 1 end
        if (sim_call_type==sim.syscb_sensing) then count = count + 10 end
        if (sim_call_type==sim.syscb_cleanup) then print('cleanup', count) end
    """
    assert old_script(tmp_path, code) == "init\ncleanup\t33\n"


def test_a_customization_script_of_v_rep_is_called_before_the_simulation(tmp_path: Path) -> None:
    code = """
        if (sim_call_type==sim_customizationscriptcall_initialization) then print('init') end
        if (sim_call_type==sim_customizationscriptcall_lastbeforesimulation) then print('before') end
    """
    assert old_script(tmp_path, code) == "init\nbefore\n"


def test_the_text_of_a_threaded_script_of_v_rep_3_5_is_its_thread(tmp_path: Path) -> None:
    code = """
        threadFunction = function()
            while sim.getSimulationState() ~= sim.simulation_advancing_abouttostop do
                print(sim.getSimulationTime())
                sim.switchThread()
            end
        end
        sim.setThreadSwitchTiming(200)
        res, err = xpcall(threadFunction, function(err) return debug.traceback(err) end)
        if not res then sim.addStatusbarMessage('Lua runtime error: '..err) end
    """
    # On a busy machine the thread may be interrupted, after 200 ms, before it prints the first time.
    assert old_script(tmp_path, code).endswith("0.05\n0.1\n0.15\n")


def test_the_text_of_a_script_of_v_rep_2_runs_in_each_step(tmp_path: Path) -> None:
    code = """
        if (simGetScriptExecutionCount()==0) then count = 0 end
        simHandleChildScript(sim_handle_all_except_explicit)
        count = count + 1
        print(count, simGetScriptExecutionCount())
    """
    assert old_script(tmp_path, code) == "1\t0\n2\t1\n3\t2\n"


def test_a_misspelled_callback_is_still_reported(tmp_path: Path) -> None:
    run = run_script(tmp_path, "function sysCal_init() sim.getObject('.') end", "--strict", name="script.lua")
    assert run.returncode == 3
    assert "it defines neither sysCall_init nor sysCall_thread" in run.stderr


def test_a_name_with_silent_error_is_no_error(tmp_path: Path) -> None:
    code = """
        function sysCall_init()
            local ball = sim.getObjectHandle('Ball@silentError')
            print(sim.getObjectHandle('Nothing@silentError'), ball == sim.getObject('/Ball'))
            print(sim.getCollisionHandle('c'), sim.readDistance(sim.getDistanceHandle('d')))
        end
    """
    assert old_script(tmp_path, code) == "-1\ttrue\n0\t0\t0.0\n"
