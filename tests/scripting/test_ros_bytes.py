# SPDX-License-Identifier: BSD-3-Clause
"""Names of message types, and arrays of bytes in messages, as in scripts of CoppeliaSim."""

from pathlib import Path

from node_support import Node, write
from ros_support import RosCore, wait_until

LUA = """
function sysCall_init()
    publisher = simROS.advertise('/bytes', 'std_msgs::UInt8MultiArray')
    simROS.publisherTreatUInt8ArrayAsString(publisher)
    simROS.subscribe('/bytes', 'std_msgs/UInt8MultiArray', 'as_table')
    local other = simROS.subscribe('/bytes', 'std_msgs/UInt8MultiArray', 'as_string')
    simROS.subscriberTreatUInt8ArrayAsString(other)
end
function sysCall_actuation() simROS.publish(publisher, {data = '\\1\\2\\3'}) end
function as_table(message) if not a then print('table', type(message.data), message.data[2]) end a = true end
function as_string(message) if not b then print('string', type(message.data), #message.data) end b = true end
"""
PYTHON = """
def sysCall_init():
    simROS.subscribe('/bytes', 'std_msgs/UInt8MultiArray', 'received')
def received(message):
    if not getattr(sysCall_init, 'done', False):
        print('python', message['data'])
    sysCall_init.done = True
"""


def test_bytes_of_messages_are_tables_in_lua_unless_a_script_wants_strings(roscore: RosCore, tmp_path: Path) -> None:
    scripts = write(tmp_path / "script.lua", LUA), write(tmp_path / "script.py", PYTHON)
    targets = [f"/Tricycle={scripts[0]}", f"/Tricycle/base_link={scripts[1]}"]
    options = [option for target in targets for option in ("--child-script", target)]
    with Node(roscore.env, tmp_path / "log", "tricycle", *options) as node:
        wait_until(lambda: node.output.count("python") and node.output.count("string"), "the messages")
        wait_until(lambda: "table\ttable\t2" in node.output, "the table")
        assert "string\tstring\t3" in node.output
        node.wait_for_output("python b'\\x01\\x02\\x03'")


SERVICES = """
function sysCall_init()
    server = simROS.advertiseService('/keep', 'bubblesim_msgs/RestoreState', 'keep')
    other = simROS.advertiseService('/give', 'bubblesim_msgs/SaveState', 'give')
    restore = simROS.serviceClient('/keep', 'bubblesim_msgs/RestoreState')
    save = simROS.serviceClient('/give', 'bubblesim_msgs/SaveState')
end
function keep(request) print('request', type(request.state), #request.state) return {success = true} end
function give(request) return {success = true, state = '\\1\\2\\3'} end
function exchange()
    simROS.call(restore, {state = {4, 5}})
    local response = simROS.call(save)
    print('response', type(response.state), #response.state)
end
function sysCall_actuation()
    if done then return end
    done = true
    exchange()
    simROS.serviceServerTreatUInt8ArrayAsString(server)
    simROS.serviceClientTreatUInt8ArrayAsString(save)
    exchange()
end
"""


def test_so_are_those_of_services(roscore: RosCore, tmp_path: Path) -> None:
    option = f"/Tricycle={write(tmp_path / 'script.lua', SERVICES)}"
    with Node(roscore.env, tmp_path / "log", "tricycle", "--child-script", option) as node:
        wait_until(lambda: node.output.count("response") == 2, "the responses")
        lines = [line.split("] ")[-1] for line in node.output.splitlines() if "request" in line or "response" in line]
        assert lines == ["request\ttable\t2", "response\ttable\t3", "request\tstring\t2", "response\tstring\t3"]


MORE = """
local transform = {header = {stamp = 0, frame_id = 'world'}, child_frame_id = 'a',
                   transform = {translation = {x = 1, y = 0, z = 0}, rotation = {x = 0, y = 0, z = 0, w = 1}}}
function sysCall_init()
    simROS.subscribe('/tf', 'tf2_msgs/TFMessage', 'placed', 10)
    local other = simROS2.createSubscription('/bytes', 'std_msgs/UInt8MultiArray', 'received')
    simROS2.subscriptionTreatUInt8ArrayAsString(other)
    publisher = simROS2.createPublisher('/bytes', 'std_msgs/UInt8MultiArray')
    local client = simROS2.createClient('/keep', 'bubblesim_msgs/RestoreState')
    local server = simROS2.createService('/keep', 'bubblesim_msgs/RestoreState', 'keep')
    simROS2.clientTreatUInt8ArrayAsString(client)
    simROS2.serviceTreatUInt8ArrayAsString(server)
    simROS2.call(client, {state = 'abc'})
    local images = simROS2.imageTransportCreateSubscription('/image', 'seen')
    simROS2.imageTransportShutdownSubscription(images)
    print('shut down', pcall(simROS2.imageTransportShutdownSubscription, images))
end
function sysCall_actuation()
    transform.header.stamp = simROS.getTime()
    simROS.sendTransforms({transform})
    simROS2.sendTransforms({})
    simROS2.publish(publisher, {data = {7, 8}})
    simROS2.spinSome()
end
function placed(message)
    if not a and #message.transforms > 0 then print('placed', message.transforms[1].child_frame_id) a = true end
end
function received(message) if not b then print('received', type(message.data)) end b = true end
function keep(request) print('kept', request.state) return {success = true} end
function seen() end
"""


def test_the_names_of_ros_2_do_the_same(roscore: RosCore, tmp_path: Path) -> None:
    option = f"/Tricycle={write(tmp_path / 'script.lua', MORE)}"
    with Node(roscore.env, tmp_path / "log", "tricycle", "--child-script", option) as node:
        for line in ("kept\tabc", "received\tstring", "placed\ta", "shut down\tfalse"):
            wait_until(lambda line=line: line in node.output, line)  # type: ignore[misc]
