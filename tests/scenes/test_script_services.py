# SPDX-License-Identifier: BSD-3-Clause
"""Services of child scripts, with a real master and rosservice."""

import subprocess
from collections.abc import Callable

import pytest

from node_support import Node
from ros_support import RosCore, wait_until

Script = Callable[[str], Node]


def offered(core: RosCore, name: str) -> None:
    wait_until(lambda: name in core.state()["services"], f"{name} to be offered")


@pytest.mark.parametrize("advertise", ["simROS.advertiseService", "simROS2.createService"])
def test_a_script_serves_others(script: Script, roscore: RosCore, advertise: str) -> None:
    script(f"""\
        def answer(request):
            return {{'success': not request['data'], 'message': 'turned'}}
        def sysCall_init():
            {advertise}('/turn', 'std_srvs/SetBool', answer)
        """)
    offered(roscore, "/turn")
    assert roscore.run("rosservice", "call", "/turn", "data: false") == 'success: True\nmessage: "turned"\n'


def test_a_script_calls_its_own_service_without_a_deadlock(script: Script) -> None:
    node = script("""\
        def sysCall_init():
            simROS.advertiseService('/own', 'std_srvs/Trigger', 'answer')
            client = simROS.serviceClient('/own', 'std_srvs/Trigger')
            print('answer:', simROS.call(client, {}))
        def answer(request):
            return {'success': True, 'message': 'mine'}
        """)
    node.wait_for_output("answer: {'success': True, 'message': 'mine'}")


def test_a_script_calls_the_services_of_other_nodes(script: Script) -> None:
    node = script("""\
        def sysCall_init():
            assert simROS2.waitForService('/rosout/get_loggers', 20)
            client = simROS2.createClient('/rosout/get_loggers', 'roscpp/GetLoggers')
            assert simROS2.waitForService(client, 20)
            print('loggers:', len(simROS2.call(client, {})['loggers']) > 0)
        """)
    node.wait_for_output("loggers: True")


def test_a_call_that_nobody_answers_is_an_error_that_a_script_can_catch(script: Script) -> None:
    node = script("""\
        def sysCall_init():
            client = simROS.serviceClient('/nobody', 'std_srvs/Empty')
            try:
                simROS.call(client, {}, 1.0)
            except RuntimeError as error:
                print('caught:', error)
                print('done')
        """)
    node.wait_for_output("done")
    assert "caught: " in node.output
    assert "/nobody" in node.output


def test_a_failing_service_ends_its_script_and_reports_the_caller(script: Script, roscore: RosCore) -> None:
    node = script("""\
        def answer(request):
            return {'sucess': True}
        def sysCall_init():
            simROS.advertiseService('/wrong', 'std_srvs/Trigger', answer)
        """)
    offered(roscore, "/wrong")
    call = ["rosservice", "call", "/wrong"]
    failed = subprocess.run(call, env=roscore.env, text=True, capture_output=True, timeout=30, check=False)
    assert failed.returncode != 0
    # rosservice's text, then the reason.
    reported = failed.stderr.partition("responded with an error: b")[2].strip("'\"\n")
    assert reported.startswith("bubblesim.MessageError: std_srvs/TriggerResponse"), failed.stderr
    assert "sucess" in reported
    assert reported.endswith("; the child script of /Ball failed or ended")
    node.wait_for_output("sucess")
    assert "the callback answer" in node.output
    assert node.process.poll() is None


def test_handles_after_shutdown_are_errors(script: Script) -> None:
    node = script("""\
        def sysCall_init():
            for make, shut_down in ((simROS.serviceClient, simROS.shutdownServiceClient),
                                    (simROS2.createClient, simROS2.shutdownClient)):
                client = make('/any', 'std_srvs/Empty')
                shut_down(client)
                for again in (lambda: simROS.call(client, {}), lambda: shut_down(client)):
                    try:
                        again()
                    except ValueError as error:
                        print('reported:', error)
            print('done')
        """)
    node.wait_for_output("done")
    assert node.output.count("reported: invalid object handle") == 4


def test_interfaces_can_be_asked_for(script: Script) -> None:
    node = script("""\
        def sysCall_init():
            assert simROS2.createInterface('geometry_msgs/Point') == {'x': 0.0, 'y': 0.0, 'z': 0.0}
            assert simROS2.getInterfaceConstants('sensor_msgs/PointField')['FLOAT32'] == 7
            assert {'std_msgs/String', 'std_srvs/Empty'} <= set(simROS2.supportedInterfaces())
            assert simROS2.timeFromFloat(1.25) == {'sec': 1, 'nanosec': 250000000}
            assert simROS2.timeToFloat({'sec': 1, 'nanosec': 250000000}) == 1.25
            print('done')
        """)
    node.wait_for_output("done")
