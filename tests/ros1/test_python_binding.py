# SPDX-License-Identifier: BSD-3-Clause
"""Services of bubblesim._core.Bridge: requests and responses as dicts, and Python's exceptions."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from node_support import Node, write
from ros_support import RosCore, wait_until

CODE = """
    from bubblesim import _core

    time_form = _core.messages.TimeForm.SECS_NSECS

    def paint(request):
        return {'success': request['data'], 'message': 'painted'} if request['data'] else None

    def refuse(request):
        raise _core.ServiceError('out of paint')

    def call(name, type_name, request):
        bridge = simROS._bridge
        client = bridge.service_client(name, type_name)
        try:
            print(bridge.call(client, request, 5.0, time_form), flush=True)
        except _core.ServiceError as error:
            print(f'ServiceError: {error}', flush=True)
        bridge.shutdown_service_client(client)

    def sysCall_init():
        bridge = simROS._bridge
        bridge.advertise_service('/paint', 'std_srvs/SetBool', paint, time_form)
        bridge.advertise_service('/refuse', 'std_srvs/Trigger', refuse, time_form)
        print('waited', bridge.wait_for_service('/nobody', 0.1))
        call('/paint', 'std_srvs/SetBool', {'data': True})
        call('/paint', 'std_srvs/SetBool', {'data': False})
        call('/refuse', 'std_srvs/Trigger', {})
        call('/nobody', 'std_srvs/Trigger', {})
"""


@pytest.fixture
def node(roscore: RosCore, tmp_path: Path) -> Iterator[Node]:
    script = write(tmp_path / "script.py", CODE)
    with Node(roscore.env, tmp_path / "log", "ball", "--child-script", f"/Ball={script}") as running:
        wait_until(lambda: "/refuse" in roscore.state()["services"], "the services")
        yield running


def test_script_calls_services(node: Node) -> None:
    node.wait_for_output("/nobody'")
    lines = [line for line in node.output.splitlines() if line.startswith(("waited", "{", "ServiceError"))]
    assert lines == [
        "waited False",
        "{'success': True, 'message': 'painted'}",
        "{'success': False, 'message': ''}",
        "ServiceError: service '/refuse' failed: out of paint",
        "ServiceError: no service '/nobody'",
    ]


def test_script_answers_rosservice(roscore: RosCore, node: Node) -> None:
    assert roscore.run("rosservice", "call", "/paint", "true") == 'success: True\nmessage: "painted"\n'
