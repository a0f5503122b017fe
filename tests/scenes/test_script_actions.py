# SPDX-License-Identifier: BSD-3-Clause
"""Actions of child scripts, with Debian's actionlib at the other end."""

import subprocess
import textwrap
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import pytest

from node_support import Node
from ros_support import DEADLINE, RosCore, start, stop, wait_until

Script = Callable[[str], Node]


SERVER_SCRIPT = """\
    def on_goal(goal_id, goal):
        if goal['goal'] == 2:
            return simROS2.goal_response_reject
        return simROS2.goal_response_accept_and_defer if goal['goal'] >= 10 else True
    def on_cancel(goal_id, goal):
        return goal['goal'] != 4
    def on_accepted(goal_id, goal):
        print('accepted', goal['goal'], flush=True)
        self.goals.append((goal_id, goal['goal']))
    def sysCall_init():
        self.goals = []
        self.server = simROS2.createActionServer(
            '/test', 'actionlib/action/Test', on_goal, 'on_cancel', on_accepted)
    def sysCall_actuation():
        for goal_id, number in self.goals:
            if not simROS2.actionServerActionIsActive(self.server, goal_id):
                continue
            if number == 10:
                simROS2.actionServerActionExecute(self.server, goal_id)
                number = 0
            if number == 0:
                simROS2.actionServerActionSucceed(self.server, goal_id, {'result': 42})
            elif number == 1:
                simROS2.actionServerActionAbort(self.server, goal_id, {'result': 43})
            elif number == 5:
                simROS2.actionServerPublishFeedback(self.server, goal_id, {'feedback': 7})
                if simROS2.actionServerActionIsCanceling(self.server, goal_id):
                    simROS2.actionServerActionSucceed(self.server, goal_id, {'result': 45})
            elif simROS2.actionServerActionIsCanceling(self.server, goal_id):
                assert not simROS2.actionServerActionIsExecuting(self.server, goal_id)
                simROS2.actionServerActionCanceled(self.server, goal_id, {'result': 44})
    """

CLIENT_SCRIPT = """\
    def on_response(goal_id, accepted):
        print(self.names[goal_id], 'accepted' if accepted else 'refused', flush=True)
    def on_feedback(goal_id, feedback):
        print(self.names[goal_id], 'feedback', feedback['feedback'], flush=True)
        assert simROS2.cancelLastGoal(self.client)
    def on_result(goal_id, code, result):
        print(self.names[goal_id], 'ended', code, result, flush=True)
    def sysCall_init():
        self.client = simROS2.createActionClient(
            '/test', 'actionlib/Test', on_response, on_feedback, 'on_result')
        self.names = {simROS2.sendGoal(self.client, {'goal': number}): number for number in range(4)}
    """

ACTIONLIB_CLIENT = """\
    import rospy, actionlib
    from actionlib.msg import TestAction, TestGoal
    from actionlib_msgs.msg import GoalStatus, GoalStatusArray
    rospy.init_node('client')
    client = actionlib.ActionClient('/test', TestAction)
    assert client.wait_for_server(rospy.Duration(20))
    def wait(condition):
        while not condition():
            rospy.sleep(0.02)
    def send(number, **callbacks):
        return client.send_goal(TestGoal(number), **callbacks)
    def is_active(goal):
        return goal.get_goal_status() == GoalStatus.ACTIVE
    def end(goal):
        wait(lambda: goal.get_comm_state() == actionlib.CommState.DONE)
        return GoalStatus.to_string(goal.get_goal_status()), goal.get_result().result
    """

ACTIONLIB_SERVER = """\
    import rospy, actionlib
    from actionlib.msg import TestAction, TestFeedback, TestResult
    def on_goal(handle):
        number = handle.get_goal().goal
        if number == 2:
            handle.set_rejected()
            return
        handle.set_accepted()
        if number == 3:
            handle.publish_feedback(TestFeedback(7))
        if number == 0:
            handle.set_succeeded(TestResult(42))
        if number == 1:
            handle.set_aborted(TestResult(43))
    def on_cancel(handle):
        handle.set_canceled(TestResult(44))
    rospy.init_node('server')
    server = actionlib.ActionServer('/test', TestAction, on_goal, on_cancel, auto_start=False)
    server.start()
    rospy.spin()
    """


def python(code: str, more: str = "") -> list[str]:
    return ["/usr/bin/python3", "-c", textwrap.dedent(code) + textwrap.dedent(more)]


def run_client(core: RosCore, code: str) -> None:
    run = subprocess.run(
        python(ACTIONLIB_CLIENT, code), env=core.env, text=True, capture_output=True, timeout=3 * DEADLINE, check=False
    )
    assert run.returncode == 0, run.stderr
    assert "Invalid goal status transition" not in run.stdout + run.stderr


@contextmanager
def actionlib_server(core: RosCore) -> Iterator[None]:
    process = start(python(ACTIONLIB_SERVER), core.env)
    try:
        yield
    finally:
        stop(process)


def test_goals_end_as_the_serving_script_decides(script: Script, roscore: RosCore) -> None:
    script(SERVER_SCRIPT)
    run_client(
        roscore,
        """\
        assert end(send(0)) == ('SUCCEEDED', 42)
        assert end(send(1)) == ('ABORTED', 43)
        assert end(send(2)) == ('REJECTED', 0)
        assert end(send(10)) == ('SUCCEEDED', 42)  # was pending first
        received = []
        goal = send(5, feedback_cb=lambda handle, feedback: received.append(feedback.feedback))
        wait(lambda: 7 in received)
        goal.cancel()
        assert end(goal) == ('SUCCEEDED', 45)  # finished before it could be cancelled
        """,
    )


def test_a_serving_script_lets_goals_be_cancelled_or_not(script: Script, roscore: RosCore) -> None:
    script(SERVER_SCRIPT)
    run_client(
        roscore,
        """\
        running, stubborn, pending, later = send(3), send(4), send(11), send(3)
        wait(lambda: is_active(running) and is_active(stubborn) and is_active(later))
        running.cancel()
        assert end(running) == ('PREEMPTED', 44)
        pending.cancel()
        assert end(pending) == ('RECALLED', 44)
        client.cancel_all_goals()
        assert end(later) == ('PREEMPTED', 44)
        assert is_active(stubborn)
        early, late = send(3), send(3)
        wait(lambda: is_active(early) and is_active(late))
        client.cancel_goals_at_and_before_time(early.comm_state_machine.action_goal.goal_id.stamp)
        assert end(early) == ('PREEMPTED', 44)
        assert is_active(late)
        """,
    )


def test_a_cancelling_that_overtakes_its_goal_holds(script: Script, roscore: RosCore) -> None:
    node = script(SERVER_SCRIPT)
    run_client(
        roscore,
        """\
        from actionlib.msg import TestActionGoal
        from actionlib_msgs.msg import GoalID
        seen = {}
        def on_status(message):
            seen.update({each.goal_id.id: each.status for each in message.status_list})
        rospy.Subscriber('/test/status', GoalStatusArray, on_status)
        client.pub_cancel.publish(GoalID(id='early'))
        wait(lambda: seen.get('early') == GoalStatus.RECALLING)
        client.pub_goal.publish(TestActionGoal(goal_id=GoalID(id='early'), goal=TestGoal(3)))
        wait(lambda: seen.get('early') == GoalStatus.RECALLED)
        """,
    )
    assert "accepted" not in node.output


def test_goals_that_are_over_leave_the_status_after_a_while(script: Script, roscore: RosCore) -> None:
    script(SERVER_SCRIPT)
    run_client(
        roscore,
        """\
        lists = []
        rospy.Subscriber('/test/status', GoalStatusArray, lambda message: lists.append(len(message.status_list)))
        wait(lambda: lists)
        assert end(send(0)) == ('SUCCEEDED', 42)
        wait(lambda: 1 in lists)
        wait(lambda: lists[-1] == 0)
        assert lists.count(1) >= 5  # it stayed, and the status was published regularly
        """,
    )


def test_a_script_sends_goals_and_receives_their_results(script: Script, roscore: RosCore) -> None:
    node = script(CLIENT_SCRIPT)  # sends before there is a server
    with actionlib_server(roscore):
        for line in (
            "0 accepted\n",
            "0 ended 4 {'result': 42}",
            "1 accepted\n",
            "1 ended 6 {'result': 43}",
            "2 refused\n",
            "3 accepted\n",
            "3 feedback 7\n",
            "3 ended 5 {'result': 44}",
        ):
            node.wait_for_output(line)
    assert "2 ended" not in node.output


def test_a_goal_that_the_server_forgot_ends_as_unknown(script: Script, roscore: RosCore) -> None:
    with actionlib_server(roscore):
        node = script("""\
            def on_response(goal_id, accepted): print('accepted', accepted, flush=True)
            def on_result(goal_id, code, result):
                print('lost', code == simROS2.action_result_code_unknown, result,
                      simROS2.cancelLastGoal(self.client), flush=True)
            def sysCall_init():
                self.client = simROS2.createActionClient(
                    '/test', 'actionlib/Test', on_response, print, on_result)
                simROS2.sendGoal(self.client, {'goal': 3})
            """)
        node.wait_for_output("accepted True")
    wait_until(lambda: "/server" not in roscore.nodes(), "the server to be gone")
    with actionlib_server(roscore):
        node.wait_for_output("lost True {'result': 0} False")


def test_a_script_can_be_client_of_its_own_server(script: Script) -> None:
    node = script("""\
        def sysCall_init():
            self.server = simROS2.createActionServer('/own', 'actionlib/TwoInts', accept, accept, execute)
            self.client = simROS2.createActionClient('/own', 'actionlib/TwoInts', print, print, on_result)
            simROS2.sendGoal(self.client, {'a': 2, 'b': 40})
        def accept(goal_id, goal): return True
        def execute(goal_id, goal):
            simROS2.actionServerActionSucceed(self.server, goal_id, {'sum': goal['a'] + goal['b']})
        def on_result(goal_id, code, result): print('sum', code, result['sum'], flush=True)
        """)
    node.wait_for_output("sum 4 42")


def test_wrong_calls_are_reported_and_change_nothing(script: Script) -> None:
    node = script("""\
        def report(function, *arguments):
            try:
                function(*arguments)
            except Exception as error:
                print('reported:', type(error).__name__, error, flush=True)
        def sysCall_init():
            report(simROS2.createActionServer, '/t', 'actionlib/Tset', print, print, print)
            report(simROS2.createActionClient, '/a b', 'actionlib/Test', print, print, print)
            server = simROS2.createActionServer('/t', 'actionlib/Test', print, print, print)
            report(simROS2.actionServerActionSucceed, server, 'nobody', {})
            client = simROS2.createActionClient('/t', 'actionlib/Test', print, print, print)
            report(simROS2.sendGoal, client, {'gaol': 1})
            print('cancelled', simROS2.cancelLastGoal(client))
            simROS2.shutdownActionServer(server)
            report(simROS2.actionServerActionIsActive, server, 'nobody')
            simROS2.shutdownActionClient(client)
            report(simROS2.sendGoal, client, {})
            print('done', flush=True)
        """)
    node.wait_for_output("done")
    reported = [line.removeprefix("reported: ") for line in node.output.splitlines() if line.startswith("reported: ")]
    for line, parts in zip(
        reported,
        (
            ("MessageError 'actionlib/Tset' is not an action type", "did you mean actionlib/Test?"),
            ("ValueError invalid topic name '/a b/",),
            ("ValueError action server '/t' has no goal 'nobody'", "its goals are none"),
            ("MessageError actionlib/TestActionGoal: ", "gaol"),
            ("ValueError invalid object handle", "no such action server, or it was shut down"),
            ("ValueError invalid object handle", "no such action client, or it was shut down"),
        ),
        strict=True,
    ):
        assert all(part in line for part in parts), line
    assert "cancelled False" in node.output


@pytest.mark.parametrize(
    ("accept", "succeed", "reported"),
    [
        ("None", "pass", "the goal callback must return True, False or one of"),
        ("2", "simROS2.actionServerActionSucceed(self.server, goal_id, {})", "is PENDING and cannot succeed; call"),
        ("True", "simROS2.actionServerActionSucceed(self.server, goal_id, {'rsult': 1})", "rsult"),
    ],
)
def test_a_server_that_fails_ends_its_script_alone(script: Script, accept: str, succeed: str, reported: str) -> None:
    node = script(f"""\
        def sysCall_init():
            self.server = simROS2.createActionServer(
                '/t', 'actionlib/Test', lambda *goal: {accept}, print, execute)
            simROS2.sendGoal(simROS2.createActionClient('/t', 'actionlib/Test', print, print, print), {{}})
        def execute(goal_id, goal):
            {succeed}
        """)
    node.wait_for_output(reported)
    assert "and is disabled" in node.output
    assert node.process.poll() is None
