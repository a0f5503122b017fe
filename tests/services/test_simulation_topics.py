# SPDX-License-Identifier: BSD-3-Clause
"""The topics of CoppeliaSim's ROS helper, used by programs made for it."""

from node_support import NAME, Node
from remote_control import Remote, Run, wait_until_sent
from ros_support import RosCore, wait_until

STATE, TIME, DONE = "/simulationState", "/simulationTime", "/simulationStepDone"
SUBSCRIBE = [f"{STATE}=Int32", f"{TIME}=Float32", f"{DONE}=Bool"]
COUNTING = """
    def sysCall_init(): pass
    def sysCall_sensing(): print(f'pass {sim.getSimulationTime():.2f}')
"""


def steps(node: Node) -> int:
    return node.output.count("pass ")


def enter_synchronous_mode(core: RosCore, node: Node, remote: Remote) -> int:
    """Start a paused node. Return the number of steps once no more come, while a service is called, and all are
    received."""
    wait_until_sent(core.env, TIME, DONE)
    remote.press("start")
    wait_until(lambda: steps(node) > 3, "steps without triggers")
    remote.send("/enableSyncMode", value=True)

    def nothing_goes_on() -> bool:
        before = steps(node)
        core.run("rosservice", "call", f"{NAME}/get_object_state", "object: /Ball")
        return steps(node) == before

    wait_until(nothing_goes_on, "the steps to wait for triggers")
    wait_until(lambda: received_steps(remote) == (steps(node), steps(node)), "all steps to be received")
    return steps(node)


def received_steps(remote: Remote) -> tuple[int, int]:
    return len(remote.received(TIME)), len(remote.received(DONE))


def test_each_trigger_gives_one_step_and_each_step_reports_that_it_is_done(run: Run, roscore: RosCore) -> None:
    node, remote = run(COUNTING, "--speed", "5", "--paused", subscribe=SUBSCRIBE)
    free = enter_synchronous_mode(roscore, node, remote)
    remote.send("/triggerNextStep", value=False, count=100)
    wait_until(lambda: len(remote.received(DONE)) == free + 100, "all to be done")
    for _ in range(3):  # one by one, like a controller
        done = len(remote.received(DONE))
        remote.send("/triggerNextStep", value=True)
        wait_until(lambda goal=done + 1: len(remote.received(DONE)) == goal, "the step to be done")
    assert steps(node) == free + 103
    assert set(remote.received(DONE)) == {"True"}
    wait_until(lambda: len(remote.received(TIME)) >= free + 103, "the times, which may arrive after what is done")
    reported = [f"{float(time):.2f}" for time in remote.received(TIME)[-103:]]
    assert reported == [f"{0.05 * number:.2f}" for number in range(free, free + 103)]

    remote.send("/enableSyncMode", value=False)
    wait_until(lambda: steps(node) > free + 200, "the steps to wait no more")


def test_triggers_of_a_pause_are_kept(run: Run, roscore: RosCore) -> None:
    node, remote = run(COUNTING, "--speed", "5", "--paused", subscribe=SUBSCRIBE)
    free = enter_synchronous_mode(roscore, node, remote)
    remote.press("pause")
    wait_until(lambda: remote.received(STATE)[-1:] == ["2"], "the pause")
    remote.send("/triggerNextStep", value=True, count=5)
    remote.press("start")
    wait_until(lambda: steps(node) == free + 5, "the steps")


def test_the_state_is_reported_in_all_states(run: Run, roscore: RosCore) -> None:
    _, remote = run(COUNTING, "--paused", subscribe=SUBSCRIBE)
    wait_until_sent(roscore.env, TIME)
    for button, state in ((None, "2"), ("start", "1"), ("stop", "0"), ("start", "1"), ("pause", "2"), ("stop", "0")):
        if button:
            remote.press(button)
        wait_until(lambda state=state: remote.received(STATE)[-1:] == [state], f"state {state} after {button}")
    wait_until(lambda: len(remote.received(TIME)) > 0, "times, which may arrive after states")
    assert remote.received(TIME)[0] == "0.0"


OWN_TIME = """
    def sysCall_init(): self.time = None
    def sysCall_actuation():
        if sim.getSimulationTime() >= {begin} and self.time is None:
            self.time = simROS.advertise('/simulationTime', 'std_msgs/Float32')
    def sysCall_sensing():
        if self.time: simROS.publish(self.time, {{'data': -sim.getSimulationTime() - 1}})
"""


def test_a_script_that_advertises_a_topic_has_it_for_itself(run: Run) -> None:
    node, remote = run(OWN_TIME.format(begin=0), "--paused", subscribe=SUBSCRIBE)
    for starts in (1, 2):
        begin = len(remote.received(TIME))
        remote.press("start")
        wait_until(lambda goal=begin + 20: len(remote.received(TIME)) > goal, "the times of the script")
        remote.press("stop")
        wait_until(lambda: remote.received(STATE)[-1:] == ["0"], f"stop {starts}")
    times = [float(time) for time in remote.received(TIME)]
    assert all(time <= -1 for time in times)
    assert "error" not in node.output


def test_a_script_may_take_a_topic_later(run: Run, roscore: RosCore) -> None:
    _, remote = run(OWN_TIME.format(begin=1), "--paused", subscribe=SUBSCRIBE)
    wait_until_sent(roscore.env, TIME)
    remote.press("start")
    # The first ones of the script may be lost: its publisher is registered meanwhile.
    wait_until(lambda: any(float(time) <= -2.5 for time in remote.received(TIME)), "the times of the script")
    times = [float(time) for time in remote.received(TIME)]
    assert times[0] == 0
    first = next(number for number, time in enumerate(times) if time < 0)
    assert all(0 <= time < 1 for time in times[:first])
    assert all(time <= -2 for time in times[first:])


def wait_until_ready(core: RosCore) -> None:
    """Return when a script's topics are registered, which happens later than its calls, but in their order."""
    wait_until(lambda: "/ready" in core.state()["publishers"], "the topics of the script to be registered")


def test_a_script_may_use_a_topic_as_another_type(run: Run, roscore: RosCore) -> None:
    node, remote = run("""
        def sysCall_init():
            self.time = simROS.advertise('/simulationTime', 'std_msgs/String')
            simROS.advertise('/ready', 'std_msgs/Empty')
        def sysCall_sensing(): simROS.publish(self.time, {'data': 'late'})
    """)
    wait_until_ready(roscore)  # before this, rostopic would find the type of the node's own topic
    assert roscore.echo(TIME).startswith('data: "late"')
    remote.press("stop")
    wait_until(lambda: "Float32" in roscore.run("rostopic", "type", TIME), "the node's own topic")
    assert "error" not in node.output


def test_a_script_that_subscribes_to_a_topic_has_it_for_itself(run: Run, roscore: RosCore) -> None:
    node, remote = run("""
        def sysCall_init():
            self.stop = simROS.subscribe('/stopSimulation', 'std_msgs/Bool', 'subscribe')
            simROS.advertise('/ready', 'std_msgs/Empty')
        def subscribe(message):
            print('received')
            simROS.shutdownSubscriber(self.stop)
        def sysCall_cleanup(): print('cleanup')
    """)
    wait_until_ready(roscore)  # before this, the message would reach nobody
    remote.press("stop")
    node.wait_for_output("received")
    roscore.run("rosservice", "call", f"{NAME}/get_object_state", "object: /Ball")  # the answer takes some steps
    assert "cleanup" not in node.output
    remote.press("stop")
    node.wait_for_output("cleanup")
