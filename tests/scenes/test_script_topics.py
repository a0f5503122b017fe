# SPDX-License-Identifier: BSD-3-Clause
"""simROS and simROS2 in child scripts, with a real master and rostopic."""

from collections.abc import Callable
from pathlib import Path

import pytest

from node_support import NAME, Node, without_slowness
from ros_peer import Peer
from ros_support import RosCore, wait_until

Script = Callable[..., Node]


@pytest.mark.parametrize(
    ("message", "reported"),
    [
        ("{'dta': 1.0}", "dta"),
        ("{'data': 'much'}", "std_msgs/Float32: data: expected"),
        ("5", "std_msgs/Float32: expected dict"),
    ],
)
def test_a_wrong_first_message_is_reported_at_once_with_type_field_and_line(
    script: Script, message: str, reported: str
) -> None:
    node = script(f"""\
        def sysCall_init():
            self.topic = simROS.advertise('/t', 'std_msgs/Float32')
        def sysCall_actuation():
            simROS.publish(self.topic, {message})
        """)
    node.wait_for_output("MessageError")
    assert "failed in sysCall_actuation" in node.output
    assert "script.py:4) and is disabled" in node.output
    assert "std_msgs/Float32" in node.output
    assert reported in node.output.splitlines()[-1]
    assert "bubblesim/scripting" not in node.output


def test_an_unlisted_type_is_reported_with_the_list_to_add_it_to(script: Script) -> None:
    node = script("def sysCall_init(): simROS.advertise('/t', 'std_msgs/Flaot32')\n")
    node.wait_for_output("and is disabled")
    node.wait_for_output("std_msgs/Flaot32")
    assert node.output.splitlines()[-1].endswith("; did you mean std_msgs/Float32?")


def test_a_type_without_fields_is_nothing_to_warn_of(script: Script, roscore: RosCore) -> None:
    node = script("def sysCall_init(): simROS.advertise('/t', 'std_msgs/Empty')\n")
    wait_until(lambda: "/t" in roscore.state()["publishers"], "the topic")
    assert node.end() == 0
    assert "empty message definition" not in node.output


def test_an_unusable_topic_name_is_reported(script: Script) -> None:
    node = script("def sysCall_init(): simROS.advertise('/a b', 'std_msgs/Float32')\n")
    node.wait_for_output("ValueError: invalid topic name '/a b'")


def test_callbacks_are_callables_or_names(script: Script, roscore: RosCore) -> None:
    node = script("""\
        class Listener:
            def receive(self, message): print('method', message['data'])
        def receive(message): print('function', message['data'])
        def sysCall_init():
            simROS.subscribe('/in', 'std_msgs/String', receive)
            simROS.subscribe('/in', 'std_msgs/msg/String', 'receive')
            simROS.subscribe('/in', 'std_msgs/String', Listener().receive)
        """)
    wait_until(lambda: "/in" in roscore.state()["subscribers"], "the subscribers")
    with roscore.publishing("/in", "std_msgs/String", "data: 'grüezi'"):
        node.wait_for_output("method grüezi")
    assert node.output.count("function grüezi") == 2


def test_an_unknown_callback_is_reported(script: Script) -> None:
    script("def sysCall_init(): simROS.subscribe('/in', 'std_msgs/Empty', 'nobody')\n").wait_for_output(
        "ValueError: the callback 'nobody' is not a function of the script"
    )


def test_a_failing_callback_ends_its_script_and_its_topics(script: Script, roscore: RosCore) -> None:
    node = script("""\
        def sysCall_init():
            simROS.subscribe('/in', 'std_msgs/Empty', fail)
            self.topic = simROS.advertise('/out', 'std_msgs/Empty')
        def fail(message):
            1 / 0
        """)
    wait_until(lambda: "/in" in roscore.state()["subscribers"], "the subscriber")
    with roscore.publishing("/in", "std_msgs/Empty"):
        node.wait_for_output("child script of /Ball failed in the callback fail")
    wait_until(lambda: "/in" not in roscore.state()["subscribers"], "the subscriber to go")
    wait_until(lambda: "/out" not in roscore.state()["publishers"], "the publisher to go")
    assert NAME in roscore.nodes()


def test_handles_cannot_be_used_after_shutdown(script: Script) -> None:
    node = script("""\
        def sysCall_init():
            topic = simROS.advertise('/out', 'std_msgs/Empty')
            simROS.shutdownPublisher(topic)
            simROS.publish(topic, {})
        """)
    node.wait_for_output("ValueError: invalid object handle")


def test_simros2_names_work(script: Script, roscore: RosCore) -> None:
    node = script("""\
        def sysCall_init():
            latch = {'depth': 1, 'durability': 'transient_local'}
            self.out = simROS2.createPublisher('/out', 'std_msgs/msg/Header', latch)
            self.listener = simROS2.createSubscription('/in', 'std_msgs/msg/Time', 'on_time')
            simROS2.publish(self.out, {'frame_id': 'x', 'stamp': {'sec': 5, 'nanosec': 6}})
            assert simROS2.getSimulationTime() == {'sec': 0, 'nanosec': 0}
            assert simROS2.getTime()['sec'] > 1e9 and simROS2.getSystemTime()['sec'] > 1e9
            assert simROS.getTime() > 1e9
        def on_time(message):
            print('received', message)
            simROS2.shutdownSubscription(self.listener)
        """)
    wait_until(lambda: "/in" in roscore.state()["subscribers"], "the subscriber")
    text = roscore.echo("/out")
    assert "secs: 5" in text
    assert text.split()[text.split().index("nsecs:") + 1] == "6"
    with roscore.publishing("/in", "std_msgs/Time", "{data: {secs: 7, nsecs: 8}}"):
        node.wait_for_output("received {'data': {'sec': 7, 'nanosec': 8}}")
    wait_until(lambda: "/in" not in roscore.state()["subscribers"], "the subscriber to go")


@pytest.mark.parametrize(
    ("name", "code"),
    [
        ("script.py", "def sysCall_init():\n    simROS.createPublisher('/t', 'std_msgs/Empty')\n"),
        ("script.lua", "function sysCall_init()\n  simROS.createPublisher('/t', 'std_msgs/Empty')\nend\n"),
    ],
)
def test_a_name_of_simros2_in_simros_is_reported_with_its_counterpart(script: Script, name: str, code: str) -> None:
    node = script(code, name)
    node.wait_for_output("is a function of simROS2; use simROS.advertise")
    assert f"{name}:2" in node.output


CLOCKS = {
    "script.py": """
        def sysCall_init():
            self.clock = simROS.advertise('/own_clock', 'rosgraph_msgs/Clock')
        def sysCall_sensing():
            simROS.publish(self.clock, {'clock': {'secs': 1, 'nsecs': 150000000.00000003}})
        """,
    "script.lua": """
        function sysCall_init()
          clock = simROS.advertise('/own_clock', 'rosgraph_msgs/Clock')
        end
        function sysCall_sensing()
          simROS.publish(clock, {clock = {secs = 1, nsecs = 150000000.00000003}})
        end
        """,
}


@pytest.mark.parametrize("name", CLOCKS)
def test_a_float_that_is_not_quite_whole_goes_into_an_integer_field(
    script: Script, roscore: RosCore, name: str
) -> None:
    node = script(CLOCKS[name], name)
    text = roscore.echo("/own_clock")
    assert text.split()[1:] == ["secs:", "1", "nsecs:", "150000000", "---"]
    assert "warning" not in without_slowness(node.output)
    assert "disabled" not in node.output


TRUNCATED = {
    "script.py": """
        def sysCall_init():
            self.topic = simROS.advertise('/t', 'std_msgs/Int8MultiArray')
        def sysCall_sensing():
            t = sim.getSimulationTime()
            simROS.publish(self.topic, {'layout': {'data_offset': 3.75 + t}, 'data': [1, -1.75]})
        """,
    "script.lua": """
        function sysCall_init()
          topic = simROS.advertise('/t', 'std_msgs/Int8MultiArray')
        end
        function sysCall_sensing()
          local t = sim.getSimulationTime()
          simROS.publish(topic, {layout = {data_offset = 3.75 + t}, data = {1, -1.75}})
        end
        """,
}


@pytest.mark.parametrize("name", TRUNCATED)
def test_a_float_that_loses_its_fraction_is_one_warning_for_each_field(
    script: Script, roscore: RosCore, name: str
) -> None:
    node = script(TRUNCATED[name], name)
    for _ in range(2):  # with and without a subscriber
        assert "data: [1, -1]" in roscore.echo("/t")
    warnings = [line for line in node.output.splitlines() if "truncated" in line]
    begin = "warning: child script of /Ball: '/t': float"
    assert warnings == [
        f"{begin} 3.75 in integer field layout.data_offset is truncated to 3",
        f"{begin} -1.75 in integer field data is truncated to -1",
    ]


LATE_ERRORS = {
    "script.py": """
        def sysCall_init():
            self.topic = simROS.advertise('/t', 'std_msgs/UInt8')
        def sysCall_sensing():
            simROS.publish(self.topic, {'data': 0 if sim.getSimulationTime() < 0.2 else float('nan')})
        """,
    "script.lua": """
        function sysCall_init()
          topic = simROS.advertise('/t', 'std_msgs/UInt8')
        end
        function sysCall_sensing()
          simROS.publish(topic, {data = sim.getSimulationTime() < 0.2 and 0 or 0 / 0})
        end
        """,
}


@pytest.mark.parametrize("name", LATE_ERRORS)
def test_messages_without_a_subscriber_are_checked_once_a_second(script: Script, name: str) -> None:
    node = script(LATE_ERRORS[name], name)
    node.wait_for_output("std_msgs/UInt8: data: expected uint8 (0 to 255), found float ")
    assert "failed in sysCall_sensing" in node.output


def test_a_float_in_a_request_or_a_response_is_one_warning_each(script: Script, roscore: RosCore) -> None:
    node = script("""\
        def sysCall_init():
            simROS.advertiseService('/set', 'sensor_msgs/SetCameraInfo', lambda request: {'success': True})
            simROS.advertiseService('/count', 'nav_msgs/GetMap', lambda request: {'map': {'info': {'width': 2.5}}})
            self.client = simROS.serviceClient('/set', 'sensor_msgs/SetCameraInfo')
            self.count = simROS.serviceClient('/count', 'nav_msgs/GetMap')
        def sysCall_sensing():
            simROS.call(self.client, {'camera_info': {'width': 1.5}})
            print(simROS.call(self.count)['map']['info']['width'])
        """)
    wait_until(lambda: node.output.count("\n2") >= 3, "three calls")
    assert node.output.count("'/set': float 1.5 in integer field camera_info.width") == 1
    assert node.output.count("'/count': float 2.5 in integer field map.info.width") == 1


VALUES = [
    ("Bool", "True", "True"),
    ("Int8", "-128", "-128"),
    ("UInt8", "255", "255"),
    ("Int16", "-32768", "-32768"),
    ("UInt16", "65535", "65535"),
    ("Int32", "-2**31", str(-(2**31))),
    ("UInt32", "2**32 - 1", str(2**32 - 1)),
    ("Int64", "-2**63", str(-(2**63))),
    ("UInt64", "2**64 - 1", str(2**64 - 1)),
    ("Float32", "0.5", "0.5"),
    ("Float64", "0.1", "0.1"),
    ("String", "''", "''"),
    ("String", "'text'", '"text"'),
]


def test_every_kind_of_value_arrives(script: Script, roscore: RosCore) -> None:
    calls = "".join(
        f"    simROS.publish(simROS.advertise('/v{i}', 'std_msgs/{kind}', 1, True), {{'data': {value}}})\n"
        for i, (kind, value, _) in enumerate(VALUES)
    )
    calls += "    simROS.publish(simROS.advertise('/vt', 'std_msgs/Time', 1, True), {'data': 2.5})\n"
    calls += "    simROS.publish(simROS.advertise('/vd', 'std_msgs/Duration', 1, True), {'data': -2.5})\n"
    calls += "    simROS.publish(simROS.advertise('/va', 'std_msgs/Float64MultiArray', 1, True), {'data': [1, 2.5]})\n"
    calls += "    print('published')\n"
    node = script("def sysCall_init():\n" + calls)
    node.wait_for_output("published")
    for i, (_, _, shown) in enumerate(VALUES):
        assert roscore.echo(f"/v{i}") == f"data: {shown}\n---\n"
    moment = roscore.echo("/vt").split()
    assert (moment[2], moment[4]) == ("2", "500000000")
    span = roscore.echo("/vd").split()
    assert int(span[2]) + int(span[4]) * 1e-9 == -2.5
    assert "data: [1.0, 2.5]" in roscore.echo("/va")


def test_what_a_script_publishes_at_its_end_arrives(script: Script, roscore: RosCore, tmp_path: Path) -> None:
    node = script("""\
        def sysCall_init():
            self.topics = [simROS.advertise(f'/topic{n}', 'std_msgs/String', 100) for n in range(4)]
        def publish(text):
            for topic in self.topics:
                simROS.publish(topic, {'data': text})
        def sysCall_actuation():
            publish('running')
        def sysCall_cleanup():
            for count in range(10):
                publish(f'{count} at the end'.rjust(50_000))
        """)
    topics = [f"/topic{n}" for n in range(4)]
    with Peer(roscore, tmp_path / "peer") as peer:
        for topic in topics:
            peer.next(topic, "std_msgs/String")
        assert node.end() == 0
        for topic in topics:
            wait_until(
                lambda topic=topic: peer.received(topic)[-1]["data"].strip() == "9 at the end",
                f"the last message on {topic}",
            )
