# SPDX-License-Identifier: BSD-3-Clause
"""A stop or a reset reaches a simulation that waits for a callback that does not return."""

import re

import pytest

from node_support import NAME
from remote_control import Run
from ros_support import RosCore, start, stop, wait_until

# Scripts that stop returning; each prints a line when it does.
PYTHON = {
    "sysCall_init": "import time\ndef sysCall_init():\n    print('stuck')\n    time.sleep(1e6)\n",
    "sysCall_actuation": """
def sysCall_init(): pass
def sysCall_actuation():
    print('stuck')
    while True: pass
""",
    "sysCall_thread": """
def sysCall_thread():
    sim.setStepping(True)
    print('stuck')
    while True: pass
""",
    "the callback on_message": """
def sysCall_init(): simROS.subscribe('/clock', 'rosgraph_msgs/Clock', on_message)
def on_message(message):
    print('stuck')
    while True: sim.getSimulationTime()
""",
    "the callback on_request": """
def sysCall_init():
    simROS.advertiseService('~stick', 'std_srvs/Empty', on_request)
    print('ready')
def on_request(request):
    print('stuck')
    while True: pass
""",
}
LUA = {
    "sysCall_actuation": """#lua
function sysCall_init() end
function sysCall_actuation()
  print('stuck')
  while true do end
end
""",
    "the callback on_message": """#lua
function sysCall_init() simROS.subscribe('/clock', 'rosgraph_msgs/Clock', 'on_message') end
function on_message(message)
  print('stuck')
  while true do sim.getSimulationTime() end
end
""",
    "the callback on_request": """#lua
function sysCall_init()
  simROS.advertiseService('~stick', 'std_srvs/Empty', 'on_request')
  print('ready')
end
function on_request(request)
  print('stuck')
  while true do end
end
""",
}
CASES = [pytest.param(where, code, id=f"python-{where}") for where, code in PYTHON.items()]
CASES += [pytest.param(where, code, id=f"lua-{where}") for where, code in LUA.items()]


@pytest.mark.parametrize(("where", "code"), CASES)
def test_a_stop_by_topic_breaks_it_off_and_a_start_begins_anew(
    run: Run, roscore: RosCore, where: str, code: str
) -> None:
    node, remote = run(code)
    if "request" in where:
        node.wait_for_output("ready")
        wait_until(lambda: f"{NAME}/stick" in roscore.state()["services"], "the service of the script")
        caller = start(["rosservice", "call", f"{NAME}/stick"], roscore.env)
    node.wait_for_output("stuck")
    remote.press("stop")
    node.wait_for_output("was interrupted")
    remote.press("start")
    if "request" in where:
        stop(caller)
        wait_until(lambda: node.output.count("ready") == 2, "the script to begin again")
    else:
        wait_until(lambda: node.output.count("stuck") == 2, "the script to begin again")
    script = re.escape("/Ball was interrupted in " + where)
    found = re.search(rf"error: child script of {script} \((.*):(\d+)\) and is disabled: it did not ret", node.output)
    assert found is not None, node.output
    assert "while " in code.splitlines()[int(found[2]) - 1] or "sleep" in code


@pytest.mark.parametrize("service", [f"{NAME}/reset_simulation", "/gazebo/reset_world"])
def test_a_reset_by_service_breaks_it_off_and_is_carried_out(run: Run, roscore: RosCore, service: str) -> None:
    node, _ = run(
        """
        def sysCall_init():
            self.steps = 0
        def sysCall_actuation():
            self.steps += 1
            while self.steps > 5: pass
        """,
        "--gazebo-compat",
    )
    wait_until(lambda: service in roscore.state()["services"], "the service")
    node.wait_for_output("the simulation is waiting")
    roscore.run("rosservice", "call", service)
    assert node.output.count("was interrupted in sysCall_actuation") == 1


def test_those_that_return_go_on(run: Run) -> None:
    node, remote = run("""
        import time
        def sysCall_init(): pass
        def sysCall_actuation():
            print('slow')
            time.sleep(0.5)
        def sysCall_cleanup():
            time.sleep(2.5)
            print('cleaned up')
    """)
    node.wait_for_output("slow")
    remote.press("stop")
    node.wait_for_output("cleaned up")
    assert "interrupted" not in node.output


def test_a_script_of_the_second_run_is_reported_and_broken_off(run: Run) -> None:
    node, remote = run("""
        import os
        number = os.environ['RUNS'] = os.environ.get('RUNS', '') + 'I'
        def sysCall_init(): print('run', number)
        def sysCall_actuation():
            while number == 'II': pass
        def sysCall_cleanup(): print('end of run', number)
    """)
    node.wait_for_output("run I\n")
    remote.press("stop")
    node.wait_for_output("end of run I\n")
    remote.press("start")
    node.wait_for_output("run II\n")
    node.wait_for_output("the simulation is waiting")
    assert "has not returned from sysCall_actuation for 1.5 s, now at " in node.output
    remote.press("stop")
    node.wait_for_output("was interrupted in sysCall_actuation")


def test_a_clean_up_that_does_not_return_is_broken_off_by_a_second_stop(run: Run) -> None:
    node, remote = run("def sysCall_init(): pass\ndef sysCall_cleanup():\n    print('stuck')\n    while True: pass\n")
    remote.press("stop")
    node.wait_for_output("stuck")
    remote.press("stop")
    node.wait_for_output("was interrupted in sysCall_cleanup")


def test_other_scripts_go_on_after_a_reset(
    run: Run, roscore: RosCore, tmp_path_factory: pytest.TempPathFactory
) -> None:
    other = tmp_path_factory.mktemp("other") / "other.py"
    other.write_text("def sysCall_init(): pass\ndef sysCall_sensing(): print('other', sim.getSimulationTime())\n")
    node, _ = run(PYTHON["sysCall_actuation"], "--child-script", f"/Ramp={other}")
    wait_until(lambda: f"{NAME}/reset" in roscore.state()["services"], "the service")
    node.wait_for_output("the simulation is waiting")
    assert "other 0" not in node.output
    roscore.run("rosservice", "call", f"{NAME}/reset")
    node.wait_for_output("other 0.1")
