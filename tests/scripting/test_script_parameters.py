# SPDX-License-Identifier: BSD-3-Clause
"""Simulation parameters of scripts: those of the file, and those that scripts set."""

from pathlib import Path

from node_support import run_script, run_sim, write

SCENE = """<?xml version="1.0"?>
<sdf version="1.9" xmlns:bubblesim="https://bubblesim"><world name="w">
  <physics type="ode"><max_step_size>0.005</max_step_size></physics>
  <model name="Robot"><static>true</static><bubblesim:is_object>false</bubblesim:is_object><link name="Robot">
    <bubblesim:place><id>1</id><script>script.lua</script>
      <parameter name="speed" unit="m/s">0.5</parameter>
      <parameter name="count" unit="">12</parameter>
      <parameter name="on" unit="">true</parameter>
      <parameter name="name" unit="">Bill</parameter>
      <parameter name="none" unit="">nil</parameter>
    </bubblesim:place>
  </link></model>
</world></sdf>
"""


def test_parameters_have_the_type_of_their_string(tmp_path: Path) -> None:
    write(tmp_path / "robot.sdf", SCENE)
    code = """
        function sysCall_init()
            local get = function(name) return sim.getScriptSimulationParameter(sim.handle_self, name) end
            print(get('speed') * 2, get('count') + 1, get('on'), get('name'), get('none'), get('missing'))
            print(type(sim.getScriptSimulationParameter(sim.handle_self, 'count', true)))
            print(sim.setScriptSimulationParameter(sim.handle_self, 'speed', 1.25), get('speed'))
            sim.setScriptSimulationParameter(sim.handle_self, 'own', false)
            print(get('own'), simGetScriptSimulationParameter(sim_handle_self, 'count'))
            local values, handles = sim.getScriptSimulationParameter(sim.handle_all, 'count')
            print(#values, values[1], handles[1] == sim.getObject('.'))
        end
    """
    write(tmp_path / "script.lua", code)
    run = run_sim(tmp_path / "robot.sdf", "--no-ros", "--speed", "max", "--until", 0.05, "--strict")
    assert run.stdout.splitlines() == [
        "1.0\t13\ttrue\tBill\tnil\tnil",
        "string",
        "1\t1.25",
        "false\t12",
        "1\t12\ttrue",
    ]


def test_user_parameters_are_those_of_the_objects_script(tmp_path: Path) -> None:
    code = """
        function sysCall_init()
          local own = sim.getObject('.')
          sim.setUserParameter(own, 'speed', 2.5)
          assert(sim.getUserParameter(own, 'speed') == 2.5)
          assert(sim.getScriptSimulationParameter(sim.handle_self, 'speed') == 2.5)
        end
    """
    run = run_script(tmp_path, code, "--strict", name="script.lua")
    assert (run.stderr, run.returncode) == ("", 0)
